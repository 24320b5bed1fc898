// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_xml_scanner_h
#define fiberloom_fabric_xml_scanner_h

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fiberloom
{
  /**
   * Reads XML from its beginning, piece by piece, as far as VTK's files need
   * it: elements with attributes, text, comments. However deep and long a file
   * is, no more is stored than the names of the elements that are open. Throws
   * InputError for what is no XML and for elements deeper than any of VTK's.
   */
  class XmlScanner
  {
  public:
    enum class Piece
    {
      opening, // of the element name()
      closing, // of the element name()
      text,    // text(), other than blanks
      end      // of the file
    };

    /** @p content has to outlive this. */
    explicit XmlScanner(const std::string_view content)
      : content(content)
    {}

    /**
     * Reads the next piece. Throws InputError where the content cannot be read
     * as XML.
     */
    Piece
    next();

    const std::string &
    name() const
    {
      return element;
    }

    /**
     * Attribute @p key of the element that was opened last, or @p otherwise .
     */
    std::string
    attribute(const std::string &key, const std::string &otherwise) const;

    std::string_view
    text() const
    {
      return found_text;
    }

    /** What has not been read yet. */
    std::string_view
    rest() const
    {
      return content.substr(position);
    }

    /** Names of the elements that are open, the outermost first. */
    const std::vector<std::string> &
    open_elements() const
    {
      return open;
    }

    /** Throws InputError with the line. */
    [[noreturn]] void
    fail(const std::string &what) const;

  private:
    std::string_view         content;
    std::size_t              position = 0;
    std::vector<std::string> open;
    std::string              element;
    bool                     closes_at_once = false; // as <a/> does
    std::string_view         found_text;
    std::vector<std::pair<std::string, std::string>> attributes;

    /** Goes behind the next @p mark and returns what is before it. */
    std::string_view
    take_until(const std::string_view mark);

    bool
    take(const std::string_view mark);

    void
    skip_blanks();

    std::string_view
    take_name();

    Piece
    open_element();

    Piece
    close_element();

    void
    read_attributes();
  };
} // namespace fiberloom

#endif
