// SPDX-License-Identifier: GPL-3.0-or-later
// Equal spheres at random in a box, audited. With what is installed:
//   c++ pack.cpp $(pkg-config --cflags --libs packing) && ./a.out
#include <cstdio>
#include <memory>
#include <packing/packing.h>
#include <stdexcept>

template <class T> using handle = std::unique_ptr<T, void (*)(T *)>;

// Makes a handle, or throws what the status says.
template <class T, class Create> handle<T> make(void (*destroy)(T *), Create create)
{
  T *made = nullptr;
  if (const packing_status status = create(&made))
    throw std::runtime_error(packing_status_string(status));
  return handle<T>(made, destroy);
}

int main()
try {
  packing_domain_box_def box;
  packing_domain_box_def_init(&box);
  box.size.x = box.size.y = box.size.z = 10;
  packing_psd_mono_def sizes;
  packing_psd_mono_def_init(&sizes);
  sizes.r = 0.5;
  packing_rsa_def rsa;
  packing_rsa_def_init(&rsa);
  rsa.volume_fraction = 0.25;

  auto domain = make<packing_domain>(packing_domain_destroy, [&](packing_domain **out) {
    return packing_domain_create_box(nullptr, &box, out);
  });
  auto psd = make<packing_psd>(packing_psd_destroy, [&](packing_psd **out) {
    return packing_psd_create_mono(nullptr, &sizes, out);
  });
  auto pack =
      make<packing_particles>(packing_particles_destroy, [&](packing_particles **out) {
        return packing_particles_create(nullptr, nullptr, out);
      });
  auto placer = make<packing_placer>(packing_placer_destroy, [&](packing_placer **out) {
    return packing_rsa_create(nullptr, &rsa, domain.get(), psd.get(), pack.get(), out);
  });

  packing_placer_report report;
  packing_placer_report_init(&report);
  while (report.state == PACKING_PLACER_RUNNING)
    if (packing_placer_step(placer.get(), 1, &report))
      throw std::runtime_error("packing_placer_step");
  packing_view view;
  packing_view_init(&view);
  packing_particles_view(pack.get(), &view);
  packing_audit_report audit;
  packing_audit_report_init(&audit);
  if (packing_audit(nullptr, nullptr, domain.get(), &view, &audit))
    throw std::runtime_error("packing_audit");
  std::printf("%zu spheres, volume fraction %.6f, audit %s\n", report.placed,
              report.volume_fraction, audit.passed ? "passed" : "failed");
  return audit.passed ? 0 : 1;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
