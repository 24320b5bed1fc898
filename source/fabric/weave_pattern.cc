// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/weave_pattern.h>

#include <map>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    /**
     * A weave whose rows are all the same but shifted: along fill tow j the
     * warp lies above at the first @p above of every @p period crossings,
     * counted from warp tow j * shift.
     */
    struct ShiftedRow
    {
      unsigned int above, period, shift;

      bool
      warp_above(const unsigned int warp, const unsigned int fill) const
      {
        return (warp + (period - shift) * fill) % period < above;
      }
    };

    const std::map<std::string, ShiftedRow> named_weaves = {
      {"plain", {1, 2, 1}},
      {"twill 2/2", {2, 4, 1}},
      {"twill 3/1", {3, 4, 1}},
      {"twill 1/3", {1, 4, 1}},
      {"satin 5", {4, 5, 2}},
      {"satin 8", {7, 8, 3}}};

    std::vector<std::string>
    split_rows(std::string text)
    {
      for (char &letter : text)
        if (letter == '/')
          letter = ' ';
      std::istringstream       in(text);
      std::vector<std::string> rows;
      for (std::string row; in >> row;)
        rows.push_back(row);
      return rows;
    }

    void
    check_rows(const std::string              &name,
               const std::vector<std::string> &rows,
               const unsigned int              n_warp_tows,
               const unsigned int              n_fill_tows)
    {
      if (rows.empty() || name.find_first_not_of("01/ ") != std::string::npos)
        throw InputError(
          "\"" + name +
          "\" is no weave; allowed: plain, twill 2/2, twill "
          "3/1, twill 1/3, satin 5, satin 8, or rows of 0 and 1");

      const std::string allowed = "; allowed: one row for each of the " +
                                  std::to_string(n_fill_tows) +
                                  " fill tows with one digit for each of the " +
                                  std::to_string(n_warp_tows) + " warp tows";
      for (const std::string &row : rows)
        if (row.size() != rows[0].size())
          throw InputError("the rows of \"" + name + "\" differ in length" +
                           allowed);
      if (rows.size() != n_fill_tows || rows[0].size() != n_warp_tows)
        throw InputError("\"" + name + "\" has " + std::to_string(rows.size()) +
                         " rows of " + std::to_string(rows[0].size()) +
                         allowed);
    }
  } // namespace

  WeavePattern::WeavePattern(const std::string &name,
                             const unsigned int n_warp_tows,
                             const unsigned int n_fill_tows)
    : above(n_fill_tows, std::vector<bool>(n_warp_tows))
  {
    const auto named = named_weaves.find(name);
    if (named != named_weaves.end())
      {
        tows_of_period = named->second.period;
        for (unsigned int fill = 0; fill < n_fill_tows; ++fill)
          for (unsigned int warp = 0; warp < n_warp_tows; ++warp)
            above[fill][warp] = named->second.warp_above(warp, fill);
        return;
      }

    const std::vector<std::string> rows = split_rows(name);
    check_rows(name, rows, n_warp_tows, n_fill_tows);
    for (unsigned int fill = 0; fill < n_fill_tows; ++fill)
      for (unsigned int warp = 0; warp < n_warp_tows; ++warp)
        above[fill][warp] = rows[fill][warp] == '1';
  }



  WeavePattern::WeavePattern(const std::vector<WeavePattern> &plies)
    : tows_of_period(plies[0].tows_of_period)
  {
    for (unsigned int p = 0; p < plies.size(); ++p)
      for (const std::vector<bool> &row : plies[p].above)
        {
          std::vector<bool> all;
          for (unsigned int other = 0; other < plies.size(); ++other)
            if (other == p)
              all.insert(all.end(), row.begin(), row.end());
            else
              all.insert(all.end(), plies[other].n_warp(), other > p);
          above.push_back(all);
        }
  }



  WeavePattern
  WeavePattern::turned() const
  {
    // Warp tow w becomes the fill tow across, counted from the other side; fill
    // tow f becomes warp tow f.
    WeavePattern       turned = *this;
    const unsigned int n      = n_warp();
    turned.above.assign(n, std::vector<bool>(above.size()));
    for (unsigned int fill = 0; fill < n; ++fill)
      for (unsigned int warp = 0; warp < above.size(); ++warp)
        turned.above[fill][warp] = !above[warp][n - 1 - fill];
    return turned;
  }
} // namespace fiberloom
