// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/accuracy.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    struct Row
    {
      double           percent;
      AccuracySettings settings;
    };

    constexpr double draft = 10, standard = 2, fine = .5;

    // From there to draft nothing is coarser.
    constexpr double loosest = 20;

    // From the largest error to the smallest.
    const std::array<Row, 4> table = {{{draft, {4, 8, .02, 1, 1e-3}},
                                       {standard, {6, 16, .02, 2, 1e-4}},
                                       {fine, {10, 32, .01, 4, 3e-5}},
                                       {.2, {12, 48, .005, 4, 1e-5}}}};

    std::optional<double>
    error_in_percent(const std::string &accuracy)
    {
      if (accuracy == "preview" || accuracy == "draft")
        return draft;
      if (accuracy == "standard")
        return standard;
      if (accuracy == "fine")
        return fine;
      if (accuracy.empty() || accuracy.back() != '%')
        return {};
      const std::string text =
        dealii::Utilities::trim(accuracy.substr(0, accuracy.size() - 1));
      const char *const end = text.data() + text.size();
      double            percent;
      const auto        read = std::from_chars(text.data(), end, percent);
      if (read.ec != std::errc() || read.ptr != end ||
          !(percent >= table.back().percent && percent <= loosest))
        return {};
      return percent;
    }

    double
    between(const double a, const double b, const double fraction)
    {
      return a == b ? a : a * std::pow(b / a, fraction);
    }
  } // namespace

  const std::string allowed_accuracies =
    "preview, draft, standard, fine, or an error from 0.2 % to 20 %, such as 2 %";

  Accuracy::Accuracy()
    : Accuracy("standard")
  {}



  Accuracy::Accuracy(const std::string &text)
    : GivenText(text)
    , preview(text == "preview")
    , error(error_in_percent(text))
  {}



  AccuracySettings
  settings_for(const double percent)
  {
    const auto   tighter  = std::find_if(table.begin() + 1,
                                      table.end() - 1,
                                      [percent](const Row &row) {
                                        return row.percent <= percent;
                                      });
    const Row   &fine     = *tighter;
    const Row   &rough    = *(tighter - 1);
    const double fraction = std::log(std::min(percent, draft) / rough.percent) /
                            std::log(fine.percent / rough.percent);
    const auto mean = [&](double AccuracySettings::*setting) {
      return between(rough.settings.*setting, fine.settings.*setting, fraction);
    };
    return {mean(&AccuracySettings::elements_per_crossing),
            mean(&AccuracySettings::elements_per_fiber),
            mean(&AccuracySettings::largest_penetration),
            mean(&AccuracySettings::stations_per_element),
            mean(&AccuracySettings::contact_tolerance)};
  }
} // namespace fiberloom
