# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""D5: engineering constants of a periodic cell that is filled with matrix, of straight fibers in one direction.

Reference: rule of mixtures along the fibers, E_m + V_f E_f, and from there the plate in plane stress whose fibers add to the stiffness along
them alone. The matrix is counted with the whole volume, as fibers and hexahedra overlap. Shear does not reach fibers, which hang on the
matrix by their axes: its modulus is that of the matrix, below what J. C. Halpin and J. L. Kardos, Polymer Engineering and Science 16
(1976), 344, give for fibers that have a volume, (1 + h V_f) / (1 - h V_f) times that with h = (G_f - G_m) / (G_f + G_m).
"""

import math

from check import Check, Report

QUICK = True
FIBER, MATRIX, NU, RADIUS, WIDTH, N_FIBERS = 73000., 3000., .35, .008, .16, 7
SHEAR, SHEAR_FIBER = MATRIX / (2 * (1 + NU)), FIBER / (2 * 1.22)


def judge(run):
    for thickness in (.02, .002):
        constants = run(f"Matrix/Thickness={thickness}").summary["stages"][-1]["engineering_constants"]
        part = N_FIBERS * math.pi * RADIUS ** 2 / (WIDTH * constants["thickness_mm"])
        plate = MATRIX / (1 - NU ** 2)
        of = f"at V_f = {part:.3f}"
        yield Check(f"E along the fibers [MPa] {of}", MATRIX + part * FIBER, constants["young_modulus_warp_MPa"], 1e-3)
        yield Check(f"E across [MPa] {of}", plate - (NU * plate) ** 2 / (plate + part * FIBER),
                    constants["young_modulus_fill_MPa"], 1e-3)
        yield Check(f"Poisson's ratio {of}", NU, constants["poisson_ratio_warp_fill"], 1e-3)
        yield Check(f"shear modulus [MPa] {of}", SHEAR, constants["shear_modulus_MPa"], 1e-3)
        h = (SHEAR_FIBER - SHEAR) / (SHEAR_FIBER + SHEAR)
        yield Report(f"shear modulus [MPa] {of}", constants["shear_modulus_MPa"],
                     f"Halpin and Tsai {SHEAR * (1 + h * part) / (1 - h * part):.5g}")
