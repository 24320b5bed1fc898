// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_parameter_catalogue_h
#define fiberloom_base_parameter_catalogue_h

#include <fiberloom/base/choices.h>
#include <fiberloom/base/given_text.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace fiberloom
{
  /**
   * Bound of points and lengths [mm]: powers of what is beyond are no numbers.
   */
  constexpr double farthest = 1e6;

  /** A bound that keeps a slip of the finger from running for ever. */
  constexpr int most_iterations = 100000;

  /** The values an entry may have: for the parser, and in words for the user.
   */
  struct Allowed
  {
    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
    std::string                                          text;

    /** Numbers above @p lower . */
    static Allowed
    above(const double lower);

    /** Numbers that are not below @p lower . */
    static Allowed
    at_least(const double lower);

    /** Numbers from @p lower to @p upper , both included. */
    static Allowed
    from_to(const double lower, const double upper);

    /** Numbers from @p lower on that are below @p upper . */
    static Allowed
    from_to_below(const double lower, const double upper);

    static Allowed
    any_number();

    /** Whole numbers from @p lower to @p upper . */
    static Allowed
    whole(const int lower, const int upper);

    /** One of these texts. */
    static Allowed
    one_of(const std::vector<std::string> &names);

    /** One of @p choices , by its name. */
    template <class Choice>
    static Allowed
    one_of(const Choices<Choice> &choices);

    static Allowed
    true_or_false();

    /** @p form says in words how the text is to look. */
    static Allowed
    text_like(const std::string &form);

    /** A list with commas, of any length that is not below @p least . */
    static Allowed
    list_of(const Allowed &item, const unsigned int least = 0);
  };

  /** The shortest decimal text that reads back as the same number. */
  std::string
  exact_text(const double value);

  /** The same for a list, with commas. */
  std::string
  exact_text(const std::vector<double> &values);

  /**
   * All parameters, as they are declared: a ParameterHandler, bound to the
   * members it fills, together with what is needed to explain them.
   */
  class ParameterCatalogue
  {
  public:
    /** One entry with all that is said of it. */
    struct Entry
    {
      std::string section; // "Fabric/Warp", empty at the top
      std::string name;
      std::string default_value;
      std::string allowed;
      std::string text;

      /** "Fabric/Warp/Tows" */
      std::string
      path() const
      {
        return section.empty() ? name : section + "/" + name;
      }
    };

    /**
     * Declares what follows in section @p name of the current one, until
     * leave_section().
     */
    void
    enter_section(const std::string &name);

    void
    leave_section();

    /**
     * Declares entry @p name of the current section. Its default is what
     * @p member is now, and parsing writes to @p member , which therefore has
     * to outlive this object.
     */
    template <class T>
    void
    add(const std::string &name,
        T                 &member,
        const std::string &text,
        const Allowed     &allowed);

    /** One of the choices there are, or a list of them. */
    template <class T>
    void
    add(const std::string &name, T &member, const std::string &text);

    /**
     * Gives the entry @p path the value. Throws InputError which starts with
     * @p origin when there is no such entry or the value is not allowed.
     */
    void
    set(const std::string &path,
        const std::string &value,
        const std::string &origin);

    /** The value in force of the entry @p path , as text. */
    std::string
    get(const std::string &path);

    /** The entry @p path ; null if there is none. */
    const Entry *
    find(const std::string &path) const;

    bool
    has_section(const std::string &path) const;

    /**
     * Says that there is no entry @p path , and names the nearest one if one is
     * near.
     */
    std::string
    explain_unknown_entry(const std::string &path) const;

    /**
     * Says that there is no section @p path , and names those there are at this
     * place.
     */
    std::string
    explain_unknown_section(const std::string &path) const;

    const std::vector<Entry> &
    entries() const
    {
      return all_entries;
    }

    dealii::ParameterHandler &
    handler()
    {
      return prm;
    }

  private:
    dealii::ParameterHandler prm;
    std::vector<std::string> sections; // now entered
    std::vector<Entry>       all_entries;

    void
    record(const std::string &name,
           const std::string &text,
           const Allowed     &allowed);
  };

  template <class T>
  void
  ParameterCatalogue::add(const std::string &name,
                          T                 &member,
                          const std::string &text,
                          const Allowed     &allowed)
  {
    // add_parameter() writes defaults with six digits, too few to repeat a run
    if constexpr (std::is_same<T, double>::value)
      {
        prm.declare_entry(name, exact_text(member), *allowed.pattern, text);
        prm.add_action(name, [&member](const std::string &value) {
          member = std::strtod(value.c_str(), nullptr);
        });
      }
    else if constexpr (std::is_same<T, std::vector<double>>::value)
      {
        prm.declare_entry(name, exact_text(member), *allowed.pattern, text);
        prm.add_action(name, [&member](const std::string &value) {
          member.clear();
          for (const std::string &number :
               dealii::Utilities::split_string_list(value, ','))
            member.push_back(std::strtod(number.c_str(), nullptr));
        });
      }
    else if constexpr (std::is_base_of<GivenText, T>::value)
      {
        prm.declare_entry(name, member.text(), *allowed.pattern, text);
        prm.add_action(name, [&member](const std::string &value) {
          member = T(value);
        });
      }
    else
      prm.add_parameter(name, member, text, *allowed.pattern);
    record(name, text, allowed);
  }

  template <class Choice>
  Allowed
  Allowed::one_of(const Choices<Choice> &choices)
  {
    std::vector<std::string> names;
    for (const auto &known : choices)
      names.push_back(known.second);
    return one_of(names);
  }

  template <class T>
  void
  ParameterCatalogue::add(const std::string &name,
                          T                 &member,
                          const std::string &text)
  {
    const auto declare =
      [&](const std::string &value, const Allowed &allowed, const auto &set) {
        prm.declare_entry(name, value, *allowed.pattern, text);
        prm.add_action(name, set);
        record(name, text, allowed);
      };
    if constexpr (std::is_enum<T>::value)
      declare(name_of(member),
              Allowed::one_of(choices<T>),
              [&member](const std::string &value) {
                member = choice_of<T>(value);
              });
    else
      {
        using Choice = typename T::value_type;
        static_assert(std::is_enum<Choice>::value);
        std::string names;
        for (const Choice choice : member)
          names += (names.empty() ? "" : ", ") + name_of(choice);
        declare(names,
                Allowed::list_of(Allowed::one_of(choices<Choice>)),
                [&member](const std::string &value) {
                  member.clear();
                  for (const std::string &item :
                       dealii::Utilities::split_string_list(value, ','))
                    member.push_back(choice_of<Choice>(item));
                });
      }
  }
} // namespace fiberloom

#endif
