/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <packing/base.h>

int packing_isa_available(packing_isa isa)
{
  switch (isa) {
  case PACKING_ISA_AUTO:
  case PACKING_ISA_BASELINE:
    return 1;
#if defined(__x86_64__) && defined(__GNUC__)
  case PACKING_ISA_AVX2:
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
           __builtin_cpu_supports("bmi2");
  case PACKING_ISA_AVX512:
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512vl") &&
                   packing_isa_available(PACKING_ISA_AVX2)
               ? 1
               : 0;
#else
  case PACKING_ISA_AVX2:
  case PACKING_ISA_AVX512:
    return 0;
#endif
  case PACKING_ISA_END:
    break;
  }
  return 0;
}

const char *packing_isa_name(packing_isa isa)
{
  switch (isa) {
  case PACKING_ISA_AUTO:
    return "auto";
  case PACKING_ISA_BASELINE:
    return "baseline";
  case PACKING_ISA_AVX2:
    return "avx2";
  case PACKING_ISA_AVX512:
    return "avx512";
  case PACKING_ISA_END:
    break;
  }
  return "unknown";
}
