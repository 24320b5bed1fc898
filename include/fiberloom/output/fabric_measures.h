// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_fabric_measures_h
#define fiberloom_output_fabric_measures_h

#include <fiberloom/stages/column.h>

#include <fiberloom/output/increment_table.h>
#include <fiberloom/output/measured_part.h>

#include <string>
#include <utility>
#include <vector>

namespace fiberloom
{
  /** Measures of a fabric with their columns, in the order of the documents. */
  using Measures = std::vector<std::pair<Column, double>>;

  /**
   * Thickness, areal weight, fractions of fiber, crimp and the tows' sections
   * of @p part of a fabric at @p q . What cannot be known, as the weight of
   * fibers without density, is left out.
   */
  Measures
  fabric_measures(const FiberSet     &fibers,
                  const FiberMesh    &mesh,
                  const DofVector    &q,
                  const MeasuredPart &part);

  /** Volume of the fibers at @p q between parameters u [mm^3]. */
  double
  fiber_volume(const FiberMesh             &mesh,
               const DofVector             &q,
               const unsigned int           fiber,
               const std::array<double, 2> &range);

  /** The rows of fabric.csv, one for each stage that is done. */
  class FabricTable : public IncrementTable
  {
  public:
    FabricTable();

    void
    append(const Place &place, const Measures &measures);

    /** Values of the last row by their headings; empty if there is none. */
    std::vector<std::pair<std::string, double>>
    last() const;
  };
} // namespace fiberloom

#endif
