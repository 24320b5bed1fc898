// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_curves_h
#define fiberloom_output_curves_h

#include <fiberloom/stages/stage.h>

#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * The rows of loading_curve.csv: stage, increment and load, then the union
   * of the columns of all stages in the order of their appearance; cells that
   * a stage does not know are empty.
   */
  class LoadingCurve
  {
  public:
    struct Row
    {
      unsigned int             stage_index; // position in the scene
      std::string              stage;
      unsigned int             increment;
      double                   load;
      std::vector<std::string> cells; // as in columns, possibly fewer
    };

    /**
     * Adds the row of an accepted increment; one of the same stage and
     * increment is replaced. Numbers are kept to 15 digits, values that are
     * not finite as empty cells.
     */
    void
    append(const unsigned int stage_index,
           const std::string &stage,
           const unsigned int increment,
           const double       load,
           const CurveRow    &values);

    /**
     * Takes up the rows of the text of a former file of a scene with @p stages
     * up to @p increment of stage @p stage_index ; those beyond are forgotten.
     * Throws InputError if @p text is no such file.
     */
    void
    continue_from(const std::string              &text,
                  const std::vector<std::string> &stages,
                  const unsigned int              stage_index,
                  const unsigned int              increment);

    /** Text of the file. */
    std::string
    str() const;

    const std::vector<std::string> &
    columns() const
    {
      return column_names;
    }

    const std::vector<Row> &
    rows() const
    {
      return all_rows;
    }

    /** The values of @p column over the rows of a stage, NaN where empty. */
    std::vector<double>
    values(const unsigned int stage_index, const unsigned int column) const;

    /** Loads of the rows of a stage. */
    std::vector<double>
    loads(const unsigned int stage_index) const;

  private:
    unsigned int
    column(const std::string &name);

    std::vector<std::string> column_names;
    std::vector<Row>         all_rows;
  };

  /**
   * The loading curve of a stage as SVG: all forces [N], or where there are
   * none all moments [N.mm], over the strain or angle that varies most, else
   * over the load. Empty when there are not two points to draw.
   */
  std::string
  curve_picture(const LoadingCurve &curve, const unsigned int stage_index);
} // namespace fiberloom

#endif
