// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/fabric/vtk_arrays.h>

#include <vtkCallbackCommand.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace fiberloom
{
  namespace
  {
    constexpr std::string_view blanks = " \t\r\n";

    [[noreturn]] void
    fail(const VtkArray &array, const std::string &what)
    {
      throw InputError("array " + array.name + " " + what);
    }

    /** Bytes of a number; 0 for what is none. */
    std::size_t
    width_of(const std::string &type)
    {
      for (const char *kind : {"Int", "UInt", "Float"})
        for (const unsigned int bits : {8, 16, 32, 64})
          if (type == kind + std::to_string(bits) &&
              (bits >= 32 || kind[0] != 'F'))
            return bits / 8;
      return 0;
    }

    bool
    is_float(const std::string &type)
    {
      return type[0] == 'F';
    }

    template <class Number>
    double
    number_at(const char *bytes)
    {
      Number number;
      std::memcpy(&number, bytes, sizeof(number));
      return number;
    }

    double
    number_at(const char *bytes, const std::string &type)
    {
      const bool is_signed = type[0] == 'I';
      switch (width_of(type))
        {
          case 1:
            return is_signed ? number_at<std::int8_t>(bytes) :
                               number_at<std::uint8_t>(bytes);
          case 2:
            return is_signed ? number_at<std::int16_t>(bytes) :
                               number_at<std::uint16_t>(bytes);
          case 4:
            return is_float(type) ? number_at<float>(bytes) :
                   is_signed      ? number_at<std::int32_t>(bytes) :
                                    number_at<std::uint32_t>(bytes);
          default:
            return is_float(type) ? number_at<double>(bytes) :
                   is_signed      ? number_at<std::int64_t>(bytes) :
                                    number_at<std::uint64_t>(bytes);
        }
    }

    /** Reverses each number of @p width bytes where the file has them so. */
    void
    order_bytes(std::string       &bytes,
                const std::size_t  width,
                const VtkEncoding &encoding)
    {
      if (encoding.big_endian)
        for (std::size_t i = 0; i + width <= bytes.size(); i += width)
          std::reverse(bytes.begin() + i, bytes.begin() + i + width);
    }

    /** Bytes as they are, or in base64. */
    class Bytes
    {
    public:
      Bytes(const VtkArray        &array,
            const std::string_view encoded,
            const ByteCode         code)
        : array(array)
        , encoded(encoded)
        , code(code)
      {}

      /** Of the encoding of @p n bytes. */
      std::size_t
      encoded_size(const std::size_t n) const
      {
        return code == ByteCode::base64 ? (n + 2) / 3 * 4 : n;
      }

      /** Of all that is encoded. */
      std::size_t
      size() const
      {
        return encoded.size();
      }

      /** The @p n bytes whose encoding begins at @p place . */
      std::string
      take(const std::size_t place, const std::size_t n) const
      {
        if (place > encoded.size() || n > encoded.size() ||
            encoded_size(n) > encoded.size() - place)
          fail(array, "is truncated, or damaged");
        const auto part = encoded.substr(place, encoded_size(n));
        if (code == ByteCode::none)
          return std::string(part);
        std::string bytes;
        bytes.reserve(part.size() / 4 * 3);
        for (std::size_t i = 0; i < part.size(); i += 4)
          append_three(part.substr(i, 4), bytes);
        bytes.resize(n);
        return bytes;
      }

    private:
      const VtkArray        &array;
      const std::string_view encoded;
      const ByteCode         code;

      void
      append_three(const std::string_view four, std::string &bytes) const
      {
        constexpr std::string_view digits =
          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::uint32_t bits = 0;
        for (const char c : four)
          {
            const std::size_t digit = c == '=' ? 0 : digits.find(c);
            if (digit == std::string_view::npos)
              fail(array, "is no base64");
            bits = (bits << 6) | digit;
          }
        for (const int shift : {16, 8, 0})
          bytes += static_cast<char>((bits >> shift) & 0xff);
      }
    };

    void
    ignore(vtkObject *, unsigned long, void *, void *)
    {}

    template <class Compressor>
    std::size_t
    uncompress_with(const std::string_view compressed,
                    char                  *bytes,
                    const std::size_t      n)
    {
      // an observer keeps its own messages off the screen
      vtkNew<vtkCallbackCommand> silence;
      silence->SetCallback(ignore);
      vtkNew<Compressor> compressor;
      compressor->AddObserver(vtkCommand::ErrorEvent, silence);
      compressor->AddObserver(vtkCommand::WarningEvent, silence);
      return compressor->Uncompress(reinterpret_cast<const unsigned char *>(
                                      compressed.data()),
                                    compressed.size(),
                                    reinterpret_cast<unsigned char *>(bytes),
                                    n);
    }

    /** Appends @p n bytes to @p bytes . */
    void
    uncompress(const std::string_view compressed,
               const std::size_t      n,
               const VtkArray        &array,
               const std::string     &compressor,
               std::string           &bytes)
    {
      const std::size_t before = bytes.size();
      bytes.resize(before + n);
      const auto read = compressor == "vtkZLibDataCompressor" ?
                          uncompress_with<vtkZLibDataCompressor> :
                        compressor == "vtkLZ4DataCompressor" ?
                          uncompress_with<vtkLZ4DataCompressor> :
                        compressor == "vtkLZMADataCompressor" ?
                          uncompress_with<vtkLZMADataCompressor> :
                          nullptr;
      if (read == nullptr)
        fail(array,
             "is compressed by " + compressor +
               "; allowed: vtkZLibDataCompressor, vtkLZ4DataCompressor, "
               "vtkLZMADataCompressor");
      if (read(compressed, bytes.data() + before, n) != n)
        fail(array, "cannot be uncompressed");
    }

    /** An array that is not text. */
    class BinaryArray
    {
    public:
      BinaryArray(const VtkArray        &array,
                  const VtkEncoding     &encoding,
                  const std::string_view encoded,
                  const ByteCode         code,
                  const std::size_t      n_bytes)
        : array(array)
        , encoding(encoding)
        , bytes(array, encoded, code)
        , n_bytes(n_bytes)
      {}

      std::string
      read() const
      {
        if (!encoding.compressor.empty())
          return read_blocks();
        const std::size_t word = encoding.wide_header ? 8 : 4;
        if (header(1)[0] != n_bytes)
          fail_size(header(1)[0]);
        return bytes.take(0, word + n_bytes).substr(word);
      }

    private:
      const VtkArray    &array;
      const VtkEncoding &encoding;
      const Bytes        bytes;
      const std::size_t  n_bytes;

      /** The first @p n sizes, none of which is larger than any array. */
      std::vector<std::size_t>
      header(const std::size_t n) const
      {
        constexpr double         most  = 1e12;
        const std::size_t        word  = encoding.wide_header ? 8 : 4;
        std::string              words = bytes.take(0, n * word);
        std::vector<std::size_t> sizes;
        order_bytes(words, word, encoding);
        for (std::size_t i = 0; i < n; ++i)
          {
            const double size =
              number_at(words.data() + i * word,
                        encoding.wide_header ? "UInt64" : "UInt32");
            if (size > most)
              fail(array, "has a size that is impossible");
            sizes.push_back(size);
          }
        return sizes;
      }

      [[noreturn]] void
      fail_size(const std::size_t found) const
      {
        fail(array,
             "has " + std::to_string(found) + " bytes; allowed: " +
               std::to_string(n_bytes) + ", as its piece says");
      }

      std::string
      read_blocks() const
      {
        const std::size_t word   = encoding.wide_header ? 8 : 4;
        const auto        first  = header(3);
        const std::size_t blocks = first[0], size = first[1],
                          last = first[2] == 0 ? size : first[2];
        // sizes of blocks are large where there is but one, which is the last
        if (blocks > n_bytes || last > n_bytes)
          fail(array, "has blocks of impossible sizes");
        const double all = blocks == 0 ? 0. : (blocks - 1.) * size + last;
        if (all != n_bytes)
          fail_size(all);

        const auto  sizes = header(3 + blocks);
        std::size_t sum   = 0;
        for (std::size_t b = 0; b < blocks; ++b)
          {
            if (sizes[3 + b] > bytes.size())
              fail(array, "is truncated, or damaged");
            sum += sizes[3 + b];
          }
        const std::string compressed =
          bytes.take(bytes.encoded_size((3 + blocks) * word), sum);
        std::string content;
        std::size_t place = 0;
        for (std::size_t b = 0; b < blocks; ++b)
          {
            uncompress(std::string_view(compressed).substr(place, sizes[3 + b]),
                       b + 1 == blocks ? last : size,
                       array,
                       encoding.compressor,
                       content);
            place += sizes[3 + b];
          }
        return content;
      }
    };

    std::vector<double>
    read_text(const VtkArray &array, const std::size_t n)
    {
      std::vector<double> numbers;
      std::size_t         end = 0;
      while (true)
        {
          const auto begin = array.text.find_first_not_of(blanks, end);
          if (begin == std::string_view::npos)
            break;
          end                = std::min(array.text.find_first_of(blanks, begin),
                         array.text.size());
          const auto  word   = array.text.substr(begin, end - begin);
          double      number = 0;
          const char *last   = word.data() + word.size();
          const auto  read   = std::from_chars(word.data(), last, number);
          if (read.ec != std::errc() || read.ptr != last)
            fail(array,
                 "holds \"" + std::string(word.substr(0, 30)) +
                   "\"; allowed: numbers");
          if (numbers.size() == n)
            fail(array,
                 "has more than " + std::to_string(n) +
                   " numbers; allowed: as many as its piece says");
          numbers.push_back(number);
        }
      if (numbers.size() != n)
        fail(array,
             "has " + std::to_string(numbers.size()) + " numbers; allowed: " +
               std::to_string(n) + ", as its piece says");
      return numbers;
    }

    std::string
    read_bytes(const VtkArray    &array,
               const VtkEncoding &encoding,
               const std::size_t  n_bytes)
    {
      if (array.format == "appended")
        {
          const std::size_t offset =
            read_count(array.offset, "offset", encoding.appended.size());
          return BinaryArray(array,
                             encoding,
                             encoding.appended.substr(offset),
                             encoding.appended_code,
                             n_bytes)
            .read();
        }
      std::string text(array.text);
      text.erase(std::remove_if(text.begin(),
                                text.end(),
                                [](const char c) {
                                  return blanks.find(c) !=
                                         std::string_view::npos;
                                }),
                 text.end());
      return BinaryArray(array, encoding, text, ByteCode::base64, n_bytes)
        .read();
    }
  } // namespace



  std::size_t
  read_count(const std::string &text,
             const std::string &name,
             const std::size_t  most)
  {
    std::size_t count = 0;
    const auto *end   = text.data() + text.size();
    const auto  read  = std::from_chars(text.data(), end, count);
    if (read.ec != std::errc() || read.ptr != end || count > most)
      throw InputError(name + " = " + text +
                       "; allowed: a whole number from 0 to " +
                       std::to_string(most));
    return count;
  }



  std::vector<double>
  read_array(const VtkArray    &array,
             const VtkEncoding &encoding,
             const std::size_t  n,
             const Numbers      allowed)
  {
    const std::size_t width = width_of(array.type);
    if (width == 0 || (allowed == Numbers::whole && is_float(array.type)))
      fail(array,
           "is of type " + array.type + "; allowed: " +
             (allowed == Numbers::whole ? "whole numbers" : "numbers"));
    if (array.format == "ascii")
      return read_text(array, n);
    if (array.format != "binary" && array.format != "appended")
      fail(array,
           "has format " + array.format + "; allowed: ascii, binary, appended");

    std::string bytes = read_bytes(array, encoding, n * width);
    order_bytes(bytes, width, encoding);
    std::vector<double> numbers(n);
    for (std::size_t i = 0; i < n; ++i)
      numbers[i] = number_at(bytes.data() + i * width, array.type);
    return numbers;
  }
} // namespace fiberloom
