// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_column_h
#define fiberloom_stages_column_h

#include <fiberloom/fabric/fiber_set.h>

#include <string>
#include <utility>
#include <vector>

namespace fiberloom
{
  /** What values are; their unit follows from it. */
  enum class Quantity
  {
    number,
    strain,
    fraction,
    angle,           // [rad]
    length,          // [mm]
    area,            // [mm2]
    curvature,       // [1/mm]
    areal_weight,    // [kg/m2]
    force,           // [N]
    force_per_width, // [N/mm]
    moment,          // [N.mm]
    pressure,        // [MPa]
    energy           // [N.mm]
  };

  /** Name of @p quantity as in headings, such as "force". */
  std::string
  name_of(const Quantity quantity);

  /** Unit of @p quantity , such as "N"; empty where values have none. */
  std::string
  unit_of(const Quantity quantity);

  /** What a column is to a test: a picture of the loading curve shows
   * responses over a deformation. */
  enum class Role
  {
    deformation, // that the test prescribes, or follows
    response,
    detail
  };

  /** A column of the loading curve. */
  struct Column
  {
    std::string name; // without unit: "force_warp"
    Quantity    quantity = Quantity::number;
    Role        role     = Role::detail;
    Tow::Family family   = Tow::Family::none; // that it is about

    /** Name and unit, such as "force_warp[N]". */
    std::string
    heading() const;
  };

  /** A heading as words: "force_warp[N]" as "force warp [N]". */
  std::string
  readable(std::string heading);

  /** One row of loading_curve.csv: columns in order, each with its value. */
  using CurveRow = std::vector<std::pair<Column, double>>;
} // namespace fiberloom

#endif
