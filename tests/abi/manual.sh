#!/usr/bin/env bash
# The manual is complete: Doxygen, told to fail on a warning, makes it.
# usage: manual.sh DOXYFILE
set -u
if ! command -v doxygen >/dev/null; then
  echo "skipped: doxygen is missing"
  exit 77
fi
output=$(mktemp -d)
trap 'rm -rf "$output"' EXIT
{
  cat "$1"
  echo "OUTPUT_DIRECTORY = $output"
} | doxygen - || exit 1
for page in index packing__rsa__def; do
  ls "$output"/html/*"$page"*.html >/dev/null || {
    echo "no page of $page"
    exit 1
  }
done
grep -q packing_rsa_create "$output/html/index.html" || {
  echo "the example is not on the main page"
  exit 1
}
