// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_given_text_h
#define fiberloom_base_given_text_h

#include <fiberloom/base/choices.h>
#include <fiberloom/base/vector_types.h>

#include <algorithm>
#include <bitset>
#include <optional>
#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * The value of an entry that stands for something else than its text. It is
   * read once, where the text is assigned; the text is kept as the user gave
   * it, since it is printed and named in messages. What cannot be read is no
   * error yet: whoever checks the parameters says what is wrong.
   */
  class GivenText
  {
  public:
    /** The text as the user gave it. */
    const std::string &
    text() const
    {
      return given;
    }

  protected:
    GivenText() = default;

    explicit GivenText(const std::string &text)
      : given(text)
    {}

  private:
    std::string given;
  };

  /** The words of @p text between blanks, or its parts between commas. */
  std::vector<std::string>
  split_names(const std::string &text, const char separator);

  /** Some of the choices there are, named one after the other. */
  template <class Choice, char separator = ' '>
  class NamedSet : public GivenText
  {
  public:
    NamedSet() = default;

    NamedSet(const std::string &text)
      : GivenText(text)
    {
      for (const std::string &name : split_names(text, separator))
        if (const auto choice = find_choice<Choice>(name))
          chosen.push_back(*choice);
        else if (!wrong_name)
          wrong_name = name;
    }

    NamedSet(const char *text)
      : NamedSet(std::string(text))
    {}

    bool
    empty() const
    {
      return chosen.empty();
    }

    bool
    has(const Choice choice) const
    {
      return std::find(chosen.begin(), chosen.end(), choice) != chosen.end();
    }

    /** One bit for each of the first @p n choices. */
    template <std::size_t n>
    std::bitset<n>
    bits() const
    {
      std::bitset<n> bits;
      for (const Choice choice : chosen)
        bits.set(static_cast<std::size_t>(choice));
      return bits;
    }

    /** The choices in the order in which they are named. */
    const std::vector<Choice> &
    list() const
    {
      return chosen;
    }

    /** The first name that is none of a choice. */
    const std::optional<std::string> &
    unknown_name() const
    {
      return wrong_name;
    }

  private:
    std::vector<Choice>        chosen;
    std::optional<std::string> wrong_name;
  };

  /** A point, "x y z", unless the text is empty. */
  class GivenPoint : public GivenText
  {
  public:
    GivenPoint() = default;

    GivenPoint(const std::string &text);

    /** The point; nothing where none is given, or the text is none. */
    const std::optional<Vector3> &
    point() const
    {
      return place;
    }

    /** Whether there is a text that is no point. */
    bool
    is_wrong() const
    {
      return !text().empty() && !place;
    }

  private:
    std::optional<Vector3> place;
  };
} // namespace fiberloom

#endif
