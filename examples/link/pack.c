/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equal spheres at random in a box, audited. With what is installed:
 *   cc pack.c $(pkg-config --cflags --libs packing) && ./a.out */
#include <packing/packing.h>
#include <stdio.h>

int main(void)
{
  packing_context *context = NULL;
  packing_domain *domain = NULL;
  packing_psd *psd = NULL;
  packing_particles *pack = NULL;
  packing_placer *placer = NULL;
  packing_domain_box_def box;
  packing_psd_mono_def sizes;
  packing_rsa_def rsa;
  packing_placer_report report;
  packing_audit_report audit;
  packing_view view;

  packing_domain_box_def_init(&box);
  box.size.x = box.size.y = box.size.z = 10;
  packing_psd_mono_def_init(&sizes);
  sizes.r = 0.5;
  packing_rsa_def_init(&rsa);
  rsa.volume_fraction = 0.25;
  packing_placer_report_init(&report);
  packing_audit_report_init(&audit);
  packing_view_init(&view);

  int failed = packing_context_create(NULL, &context) ||
               packing_domain_create_box(context, &box, &domain) ||
               packing_psd_create_mono(context, &sizes, &psd) ||
               packing_particles_create(context, NULL, &pack) ||
               packing_rsa_create(context, &rsa, domain, psd, pack, &placer);
  while (!failed && report.state == PACKING_PLACER_RUNNING)
    failed = packing_placer_step(placer, 1, &report);
  if (!failed) {
    packing_particles_view(pack, &view);
    failed = packing_audit(context, NULL, domain, &view, &audit);
  }
  if (failed)
    fprintf(stderr, "%s\n", packing_context_message(context));
  else
    printf("%zu spheres, volume fraction %.6f, audit %s\n", report.placed,
           report.volume_fraction, audit.passed ? "passed" : "failed");
  packing_placer_destroy(placer);
  packing_particles_destroy(pack);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  packing_context_destroy(context);
  return failed || !audit.passed;
}
