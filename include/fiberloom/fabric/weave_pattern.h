// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_weave_pattern_h
#define fiberloom_fabric_weave_pattern_h

#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * The superimposition order of a weave: for each crossing of warp tow i and
   * fill tow j, which of the two lies above (section 4.1 of the paper).
   */
  class WeavePattern
  {
  public:
    /**
     * @p name is one of plain, "twill 2/2", "twill 3/1", "twill 1/3",
     * "satin 5", "satin 8", or rows of the whole sample, one per fill tow,
     * separated by "/" or blanks, with 1 where the warp tow is above and 0
     * where it is below, such as "1010 0101". Throws InputError if the name
     * is unknown, the rows are not rectangular or do not match the numbers of
     * tows.
     */
    WeavePattern(const std::string &name,
                 const unsigned int n_warp_tows,
                 const unsigned int n_fill_tows);

    /**
     * The pattern of a stack: tows of all @p plies , the lowest first, numbered
     * through. Those of an upper ply are above all of those below it.
     */
    explicit WeavePattern(const std::vector<WeavePattern> &plies);

    /**
     * The pattern of the fabric turned by a quarter, against the clock seen
     * from above, whose tows are numbered along the axes again.
     */
    WeavePattern
    turned() const;

    bool
    warp_above(const unsigned int warp, const unsigned int fill) const
    {
      return above[fill][warp];
    }

    /**
     * Number of tows after which a weave with a name repeats itself; 0 for
     * rows.
     */
    unsigned int
    period() const
    {
      return tows_of_period;
    }

  private:
    std::vector<std::vector<bool>> above; // [fill][warp]
    unsigned int                   tows_of_period = 0;

    unsigned int
    n_warp() const
    {
      return above[0].size();
    }
  };
} // namespace fiberloom

#endif
