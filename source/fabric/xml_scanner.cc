// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/xml_scanner.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    // VTK's own files have 6 elements in each other and 15 attributes.
    constexpr std::size_t deepest = 30, most_attributes = 100;

    constexpr std::string_view blanks = " \t\r\n";

    std::string
    without_entities(const std::string_view value)
    {
      static const std::pair<std::string_view, char> entities[] = {
        {"&lt;", '<'},
        {"&gt;", '>'},
        {"&amp;", '&'},
        {"&quot;", '"'},
        {"&apos;", '\''}};
      std::string text;
      for (std::size_t i = 0; i < value.size();)
        {
          const auto *entity = std::find_if(
            std::begin(entities), std::end(entities), [&](const auto &known) {
              return value.compare(i, known.first.size(), known.first) == 0;
            });
          const bool known = entity != std::end(entities);
          text += known ? entity->second : value[i];
          i += known ? entity->first.size() : 1;
        }
      return text;
    }
  } // namespace



  XmlScanner::Piece
  XmlScanner::next()
  {
    if (closes_at_once)
      {
        closes_at_once = false;
        open.pop_back();
        return Piece::closing;
      }
    while (position < content.size())
      {
        if (content[position] != '<')
          {
            found_text = content.substr(position);
            found_text = found_text.substr(0, found_text.find('<'));
            position += found_text.size();
            if (found_text.find_first_not_of(blanks) != std::string_view::npos)
              return Piece::text;
          }
        else if (take("<!--"))
          take_until("-->");
        else if (take("<?"))
          take_until("?>");
        else if (take("</"))
          return close_element();
        else
          {
            ++position;
            return open_element();
          }
      }
    if (!open.empty())
      fail("the file ends within " + open.back());
    return Piece::end;
  }



  std::string
  XmlScanner::attribute(const std::string &key,
                        const std::string &otherwise) const
  {
    for (const auto &[name, value] : attributes)
      if (name == key)
        return value;
    return otherwise;
  }



  void
  XmlScanner::fail(const std::string &what) const
  {
    const auto before = content.substr(0, position);
    throw InputError(
      "line " +
      std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
      ": " + what);
  }



  std::string_view
  XmlScanner::take_until(const std::string_view mark)
  {
    const std::size_t end = content.find(mark, position);
    if (end == std::string_view::npos)
      fail("there is no " + std::string(mark) + " to what begins here");
    const auto before = content.substr(position, end - position);
    position          = end + mark.size();
    return before;
  }



  bool
  XmlScanner::take(const std::string_view mark)
  {
    if (content.compare(position, mark.size(), mark) != 0)
      return false;
    position += mark.size();
    return true;
  }



  void
  XmlScanner::skip_blanks()
  {
    position =
      std::min(content.find_first_not_of(blanks, position), content.size());
  }



  std::string_view
  XmlScanner::take_name()
  {
    const std::size_t end =
      std::min(content.find_first_of(" \t\r\n=/><\"'", position),
               content.size());
    const auto name = content.substr(position, end - position);
    if (name.empty())
      fail("a name is missing");
    position = end;
    return name;
  }



  XmlScanner::Piece
  XmlScanner::open_element()
  {
    element = take_name();
    read_attributes();
    closes_at_once = take("/");
    if (!take(">"))
      fail("element " + element + " does not end with >");
    if (open.size() == deepest)
      fail("an element within " + std::to_string(deepest) + " others");
    open.push_back(element);
    return Piece::opening;
  }



  XmlScanner::Piece
  XmlScanner::close_element()
  {
    element = take_name();
    skip_blanks();
    if (!take(">"))
      fail("element " + element + " does not end with >");
    if (open.empty() || open.back() != element)
      fail("element " + element + " ends where " +
           (open.empty() ? "none" : open.back()) + " is open");
    open.pop_back();
    return Piece::closing;
  }



  void
  XmlScanner::read_attributes()
  {
    attributes.clear();
    for (skip_blanks(); position < content.size() && content[position] != '/' &&
                        content[position] != '>';
         skip_blanks())
      {
        const std::string key(take_name());
        skip_blanks();
        if (!take("="))
          fail("attribute " + key + " of " + element + " has no value");
        skip_blanks();
        const bool single = take("'");
        if (!single && !take("\""))
          fail("attribute " + key + " of " + element + " has no quotes");
        const auto value = take_until(single ? "'" : "\"");
        if (attributes.size() == most_attributes ||
            std::any_of(attributes.begin(),
                        attributes.end(),
                        [&key](const auto &former) {
                          return former.first == key;
                        }))
          fail("attribute " + key + " of " + element + " is one too many");
        attributes.emplace_back(key, without_entities(value));
      }
  }
} // namespace fiberloom
