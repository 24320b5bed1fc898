// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_fabric_vtk_arrays_h
#define fiberloom_fabric_vtk_arrays_h

#include <string>
#include <string_view>
#include <vector>

namespace fiberloom
{
  /** An element DataArray of a file of VTK, as it stands there. */
  struct VtkArray
  {
    std::string      type; // Float64, Int32 ...
    std::string      name;
    std::string      n_components;
    std::string      format; // ascii, binary, appended
    std::string      offset; // within the appended data
    std::string_view text;   // of the element itself
  };

  /** How bytes are coded as text. */
  enum class ByteCode
  {
    none,
    base64
  };

  /** How numbers that are not text stand in a file of VTK. */
  struct VtkEncoding
  {
    bool             big_endian  = false;
    bool             wide_header = false; // sizes have 64 bits
    std::string      compressor;          // name of VTK's class; empty: none
    std::string_view appended;            // data behind the elements
    ByteCode         appended_code = ByteCode::none;
  };

  /**
   * A whole number that an attribute gives, at most @p most . Throws
   * InputError.
   */
  std::size_t
  read_count(const std::string &text,
             const std::string &name,
             const std::size_t  most);

  /** What an array may hold. */
  enum class Numbers
  {
    any,
    whole
  };

  /**
   * The @p n numbers of @p array , which has to have just as many. Nothing is
   * allocated by sizes that stand in the file. Throws InputError.
   */
  std::vector<double>
  read_array(const VtkArray    &array,
             const VtkEncoding &encoding,
             const std::size_t  n,
             const Numbers      allowed);
} // namespace fiberloom

#endif
