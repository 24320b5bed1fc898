// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/fiber_points.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <regex>

namespace fiberloom
{
  const std::string
    fibers_allowed =
      "a list such as all, 0, 3-5, or in a fabric warp, fill 0-2",
    points_allowed = "a list such as 0 start, 3-5 end, all at 0.5, 1 whole, "
                     "or in a fabric warp start, fill 2 end";



  unsigned int
  FiberPoint::nearest_node() const
  {
    return std::lround(position);
  }



  bool
  FiberPoint::is_node() const
  {
    return std::abs(position - nearest_node()) < 1e-6;
  }



  namespace
  {
    // Regular expressions of the standard library exhaust the stack on more.
    constexpr std::size_t longest_item = 1000;

    /** The numbers of "2" or "3-5", which must be below @p n . */
    std::vector<unsigned int>
    read_range(const std::string &text,
               const unsigned int n,
               const std::string &what,
               const std::string &item)
    {
      const unsigned long first = std::stoul(text);
      const std::size_t   dash  = text.find('-');
      const unsigned long last =
        dash == std::string::npos ? first : std::stoul(text.substr(dash + 1));
      if (last >= n)
        throw InputError("there is no " + what + " for " + item +
                         "; allowed: numbers from 0 to " +
                         std::to_string(n - 1));
      if (last < first)
        throw InputError("\"" + item +
                         "\" runs backwards; allowed: the smaller number "
                         "first");
      std::vector<unsigned int> numbers;
      for (unsigned int i = first; i <= last; ++i)
        numbers.push_back(i);
      return numbers;
    }

    /** The fibers of the tows of a family, or of some of them. */
    std::vector<unsigned int>
    fibers_of_family(const std::string &family,
                     const std::string &numbers,
                     const FiberSet    &set,
                     const std::string &item)
    {
      std::vector<const Tow *> tows;
      for (const Tow &tow : set.tows)
        if (tow.family ==
            (family == "warp" ? Tow::Family::warp : Tow::Family::fill))
          tows.push_back(&tow);
      if (tows.empty())
        throw InputError("there is no " + family + " for " + item +
                         "; allowed: numbers of fibers, or all");

      std::vector<const Tow *> chosen;
      if (numbers.empty() || numbers == "all")
        chosen = tows;
      else
        for (const unsigned int t :
             read_range(numbers, tows.size(), family + " tow", item))
          chosen.push_back(tows[t]);
      std::vector<unsigned int> fibers;
      for (const Tow *tow : chosen)
        fibers.insert(fibers.end(), tow->fibers.begin(), tow->fibers.end());
      return fibers;
    }

    /** @p which is the part of @p item that names fibers. */
    std::vector<unsigned int>
    find_fibers_of_item(const std::string &which,
                        const FiberSet    &set,
                        const std::string &item,
                        const std::string &allowed)
    {
      static const std::regex form(
        "(warp|fill)?\\s*(all|\\d{1,9}(-\\d{1,9})?)?");
      std::smatch match;
      if (which.empty() || which.size() > longest_item ||
          !std::regex_match(which, match, form))
        throw InputError("\"" + item + "\" names nothing; allowed: " + allowed);
      if (match[1].matched)
        return fibers_of_family(match[1], match[2], set, item);
      if (match[2] == "all")
        return read_range("0-" + std::to_string(set.fibers.size() - 1),
                          set.fibers.size(),
                          "fiber",
                          item);
      return read_range(match[2], set.fibers.size(), "fiber", item);
    }

    /** Position in nodes at a fraction of the length of a fiber. */
    double
    position_at(const Fiber &fiber, const double fraction)
    {
      const auto         &x = fiber.centers;
      std::vector<double> length(1, 0.);
      for (std::size_t n = 1; n < x.size(); ++n)
        length.push_back(length.back() + (x[n] - x[n - 1]).norm());
      const double s = fraction * length.back();
      // the first node at or beyond s
      const std::size_t n = std::max<std::size_t>(
        1,
        std::lower_bound(length.begin(), length.end() - 1, s) - length.begin());
      return n - (length[n] - s) / (length[n] - length[n - 1]);
    }

    std::vector<FiberPoint>
    points_of(const unsigned int fiber,
              const std::string &where,
              const std::string &fraction,
              const FiberSet    &set)
    {
      const Fiber       &line = set.fibers[fiber];
      const unsigned int last = line.centers.size() - 1;
      if (where == "start")
        return {{fiber, where, 0.}};
      if (where == "end")
        return {{fiber, where, double(last)}};
      if (where == "whole")
        {
          std::vector<FiberPoint> points;
          for (unsigned int n = 0; n <= last; ++n)
            points.push_back({fiber, where, double(n)});
          return points;
        }
      return {
        {fiber, "at " + fraction, position_at(line, std::stod(fraction))}};
    }
  } // namespace



  std::vector<unsigned int>
  find_fibers(const std::string &list, const FiberSet &set)
  {
    std::vector<unsigned int> fibers;
    for (const std::string &item :
         dealii::Utilities::split_string_list(list, ','))
      for (const unsigned int fiber :
           find_fibers_of_item(item, set, item, fibers_allowed))
        fibers.push_back(fiber);
    return fibers;
  }



  std::vector<FiberPoint>
  find_points(const std::string &list, const FiberSet &set)
  {
    static const std::regex form("(.*?)\\s*(start|end|whole|at\\s+(\\S+))");
    static const std::regex fraction("(0|1|0?\\.\\d+|0\\.|1\\.0*)");
    std::vector<FiberPoint> points;
    for (const std::string &item :
         dealii::Utilities::split_string_list(list, ','))
      {
        std::smatch match;
        if (item.size() > longest_item || !std::regex_match(item, match, form))
          throw InputError(
            "\"" + item +
            "\" is no point of a fiber; allowed: " + points_allowed);
        if (match[3].matched && !std::regex_match(match[3].str(), fraction))
          throw InputError("\"" + item +
                           "\" is no point of a fiber; allowed after at: a "
                           "fraction of the length from 0 to 1, such as 0.5");
        for (const unsigned int fiber :
             find_fibers_of_item(match[1], set, item, points_allowed))
          for (const FiberPoint &point :
               points_of(fiber, match[2], match[3], set))
            points.push_back(point);
      }
    return points;
  }
} // namespace fiberloom
