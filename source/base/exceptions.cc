// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/memory.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <sstream>
#include <string_view>

namespace fiberloom
{
  namespace
  {
    constexpr std::size_t longest_end = 500; // of a message, in characters

    /** A character of UTF-8. */
    struct Character
    {
      std::uint32_t code;
      std::size_t   n_bytes; // 0: these are none
    };

    /** The first one of @p text . */
    Character
    first_character(const std::string_view text)
    {
      const auto byte = [&text](const std::size_t i) {
        return static_cast<unsigned char>(text[i]);
      };
      const unsigned char first = byte(0);
      if (first < 0x80)
        return {first, 1};
      const std::size_t n = first < 0xc2 ? 0 :
                            first < 0xe0 ? 2 :
                            first < 0xf0 ? 3 :
                            first < 0xf5 ? 4 :
                                           0;
      if (n == 0 || text.size() < n)
        return {0, 0};
      std::uint32_t code = first & (0x7f >> n);
      for (std::size_t i = 1; i < n; ++i)
        {
          if ((byte(i) & 0xc0) != 0x80)
            return {0, 0};
          code = (code << 6) | (byte(i) & 0x3f);
        }
      return {code, n};
    }

    /** Control characters, and those that break or turn lines. */
    bool
    steers_terminal(const std::uint32_t code)
    {
      return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x200e ||
             code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
             (code >= 0x2066 && code <= 0x2069) || code == 0xfeff;
    }

    void
    append_bytes(std::string &line, const std::string_view bytes)
    {
      constexpr const char *digits = "0123456789abcdef";
      for (const unsigned char byte : bytes)
        {
          line += "\\x";
          line += digits[byte / 16];
          line += digits[byte % 16];
        }
    }
  } // namespace

  std::string
  printable(const std::string &text)
  {
    std::string            line;
    const std::string_view all = text;
    for (std::size_t i = 0; i < text.size();)
      {
        const Character   character = first_character(all.substr(i));
        const std::size_t n = std::max<std::size_t>(character.n_bytes, 1);
        if (character.n_bytes == 0 || steers_terminal(character.code))
          append_bytes(line, all.substr(i, n));
        else
          line += all.substr(i, n);
        i += n;
      }
    return line;
  }

  std::string
  one_line(const std::exception &exception)
  {
    std::stringstream text;
    if (const auto *library_exception =
          dynamic_cast<const dealii::ExceptionBase *>(&exception))
      library_exception->print_info(text);
    else if (dynamic_cast<const std::bad_alloc *>(&exception))
      text << out_of_memory();
    else
      text << exception.what();

    std::string line, word;
    while (text >> word)
      line += (line.empty() ? "" : " ") + word;
    // a value may be as long as a file, but place and reason stand at the ends
    if (line.size() > 2 * longest_end)
      line = line.substr(0, longest_end) + " ... " +
             line.substr(line.size() - longest_end);
    return printable(line);
  }
} // namespace fiberloom
