// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace fiberloom
{
  namespace
  {
    constexpr double largest = std::numeric_limits<double>::max();

    Allowed
    number(const double lower, const double upper, const std::string &text)
    {
      return {std::make_shared<dealii::Patterns::Double>(lower, upper), text};
    }

    std::string
    join(const std::vector<std::string> &words, const std::string &separator)
    {
      std::string text;
      for (const std::string &word : words)
        text += (text.empty() ? "" : separator) + word;
      return text;
    }

    /** Levenshtein's: the least number of letters to add, drop or change. */
    std::size_t
    edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          std::size_t diagonal = i;
          row[0]               = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const std::size_t changed = diagonal + (a[i] != b[j]);
              diagonal                  = row[j + 1];
              row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
            }
        }
      return row.back();
    }

    /** The last name of a path and the names before it. */
    std::pair<std::vector<std::string>, std::string>
    split_path(const std::string &path)
    {
      std::vector<std::string> sections =
        dealii::Utilities::split_string_list(path, '/');
      if (sections.empty())
        return {};
      const std::string name = sections.back();
      sections.pop_back();
      return {sections, name};
    }

    /** Is in the sections of a handler for as long as it lives. */
    struct Visit
    {
      dealii::ParameterHandler      &prm;
      const std::vector<std::string> sections;

      Visit(dealii::ParameterHandler       &prm,
            const std::vector<std::string> &sections)
        : prm(prm)
        , sections(sections)
      {
        for (const std::string &section : sections)
          prm.enter_subsection(section);
      }

      ~Visit()
      {
        for (std::size_t i = 0; i < sections.size(); ++i)
          prm.leave_subsection();
      }
    };
  } // namespace

  Allowed
  Allowed::above(const double lower)
  {
    return number(std::nextafter(lower, largest),
                  largest,
                  "a number above " + exact_text(lower));
  }

  Allowed
  Allowed::at_least(const double lower)
  {
    return number(lower, largest, "a number of at least " + exact_text(lower));
  }

  Allowed
  Allowed::from_to(const double lower, const double upper)
  {
    return number(lower,
                  upper,
                  "a number from " + exact_text(lower) + " to " +
                    exact_text(upper));
  }

  Allowed
  Allowed::from_to_below(const double lower, const double upper)
  {
    return number(lower,
                  std::nextafter(upper, lower),
                  "a number of at least " + exact_text(lower) + " and below " +
                    exact_text(upper));
  }

  Allowed
  Allowed::any_number()
  {
    return number(-largest, largest, "a number");
  }

  Allowed
  Allowed::whole(const int lower, const int upper)
  {
    return {std::make_shared<dealii::Patterns::Integer>(lower, upper),
            "a whole number from " + std::to_string(lower) + " to " +
              std::to_string(upper)};
  }

  Allowed
  Allowed::one_of(const std::vector<std::string> &names)
  {
    return {std::make_shared<dealii::Patterns::Selection>(join(names, "|")),
            join(names, ", ")};
  }

  Allowed
  Allowed::true_or_false()
  {
    return {std::make_shared<dealii::Patterns::Bool>(), "true, false"};
  }

  Allowed
  Allowed::text_like(const std::string &form)
  {
    return {std::make_shared<dealii::Patterns::Anything>(), form};
  }

  Allowed
  Allowed::list_of(const Allowed &item, const unsigned int least)
  {
    return {std::make_shared<dealii::Patterns::List>(*item.pattern, least),
            "list with commas of: " + item.text};
  }

  std::string
  exact_text(const double value)
  {
    char       text[64];
    const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
    return std::string(text, end);
  }

  std::string
  exact_text(const std::vector<double> &values)
  {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + exact_text(value);
    return text;
  }

  void
  ParameterCatalogue::enter_section(const std::string &name)
  {
    prm.enter_subsection(name);
    sections.push_back(name);
  }

  void
  ParameterCatalogue::leave_section()
  {
    prm.leave_subsection();
    sections.pop_back();
  }

  void
  ParameterCatalogue::record(const std::string &name,
                             const std::string &text,
                             const Allowed     &allowed)
  {
    all_entries.push_back(
      {join(sections, "/"), name, prm.get(name), allowed.text, text});
  }

  void
  ParameterCatalogue::set(const std::string &path,
                          const std::string &value,
                          const std::string &origin)
  {
    const Entry *entry = find(path);
    if (entry == nullptr)
      throw InputError(origin + ": " + explain_unknown_entry(path));

    const auto [in_sections, name] = split_path(path);
    const Visit visit(prm, in_sections);
    try
      {
        prm.set(name, value);
      }
    catch (const dealii::ExceptionBase &)
      {
        throw InputError(origin + ": " + path + " = " + value +
                         " is not allowed; allowed: " + entry->allowed);
      }
  }

  std::string
  ParameterCatalogue::get(const std::string &path)
  {
    const auto [in_sections, name] = split_path(path);
    const Visit visit(prm, in_sections);
    return prm.get(name);
  }

  const ParameterCatalogue::Entry *
  ParameterCatalogue::find(const std::string &path) const
  {
    const auto entry = std::find_if(all_entries.begin(),
                                    all_entries.end(),
                                    [&path](const Entry &candidate) {
                                      return candidate.path() == path;
                                    });
    return entry == all_entries.end() ? nullptr : &*entry;
  }

  bool
  ParameterCatalogue::has_section(const std::string &path) const
  {
    return std::any_of(all_entries.begin(),
                       all_entries.end(),
                       [&path](const Entry &entry) {
                         return (entry.section + "/").rfind(path + "/", 0) == 0;
                       });
  }

  std::string
  ParameterCatalogue::explain_unknown_entry(const std::string &path) const
  {
    const std::string name = split_path(path).second;
    std::string       nearest;
    std::size_t       least = 1 + path.size() / 3;
    for (const Entry &entry : all_entries)
      {
        const std::string known = entry.path();
        // the right name in the wrong section is near, too
        std::size_t distance = entry.name == name ? 1 : least;
        // what is much longer is not near, and would take long to compare
        if (path.size() < 2 * known.size())
          distance = std::min(distance, edit_distance(known, path));
        if (distance < least)
          {
            least   = distance;
            nearest = entry.path();
          }
      }
    return "there is no entry " + path +
           (nearest.empty() ? "; all are listed by --print-parameters" :
                              "; is " + nearest + " meant?");
  }

  std::string
  ParameterCatalogue::explain_unknown_section(const std::string &path) const
  {
    if (path.rfind("Drive ", 0) == 0)
      return "there is no section " + path +
             "; drives have to be named in the entry Drives";

    const std::string     parent = join(split_path(path).first, "/");
    std::set<std::string> known;
    for (const Entry &entry : all_entries)
      {
        std::vector<std::string> names =
          dealii::Utilities::split_string_list(entry.section, '/');
        const std::size_t depth = split_path(path).first.size();
        if (names.size() <= depth)
          continue;
        const std::string name = names[depth];
        names.resize(depth);
        if (join(names, "/") == parent)
          known.insert(name);
      }
    return "there is no section " + path + "; allowed: " +
           (known.empty() ? "none" : join({known.begin(), known.end()}, ", "));
  }
} // namespace fiberloom
