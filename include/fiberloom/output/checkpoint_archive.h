// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_checkpoint_archive_h
#define fiberloom_output_checkpoint_archive_h

#include <boost/archive/archive_exception.hpp>
#include <boost/archive/binary_iarchive_impl.hpp>
#include <boost/archive/detail/register_archive.hpp>
#include <boost/serialization/collection_size_type.hpp>

#include <Eigen/Core>

#include <istream>
#include <string>

namespace fiberloom
{
  /**
   * Reads what Boost's binary archive has written, but believes no size that it
   * finds: an element of a list takes at least a byte, a value of a vector of
   * dofs eight of those that are left. Throws
   * boost::archive::archive_exception.
   */
  class CheckpointArchive
    : public boost::archive::
        binary_iarchive_impl<CheckpointArchive, char, std::char_traits<char>>
  {
    using Base = boost::archive::
      binary_iarchive_impl<CheckpointArchive, char, std::char_traits<char>>;
    friend class boost::archive::detail::interface_iarchive<CheckpointArchive>;
    friend class boost::archive::basic_binary_iarchive<CheckpointArchive>;
    friend class boost::archive::load_access;

  public:
    explicit CheckpointArchive(std::istream &in)
      : Base(in, 0)
      , buffer(*in.rdbuf())
    {
      init(0);
    }

  private:
    std::streambuf &buffer;

    [[noreturn]] static void
    fail()
    {
      throw boost::archive::archive_exception(
        boost::archive::archive_exception::input_stream_error);
    }

    /** Bytes that are left in the stream, which holds all in memory. */
    double
    bytes_left()
    {
      return buffer.in_avail();
    }

    template <class T>
    void
    load_override(T &value)
    {
      Base::load_override(value);
    }

    void
    load_override(boost::serialization::collection_size_type &size)
    {
      Base::load_override(size);
      if (static_cast<std::size_t>(size) > bytes_left())
        fail();
    }

    /** Reads the size of a vector of numbers; nothing else has this type. */
    void
    load_override(Eigen::Index &size)
    {
      Base::load_override(size);
      if (size < 0 || 8. * size > bytes_left())
        fail();
    }

    void
    load_override(bool &value)
    {
      unsigned char byte = 0;
      load_binary(&byte, 1);
      if (byte > 1)
        fail();
      value = byte == 1;
    }

    void
    load_override(std::string &text)
    {
      std::size_t size = 0;
      load_binary(&size, sizeof(size));
      if (size > bytes_left())
        fail();
      text.resize(size);
      load_binary(text.data(), size);
    }
  };
} // namespace fiberloom

BOOST_SERIALIZATION_REGISTER_ARCHIVE(fiberloom::CheckpointArchive)
BOOST_SERIALIZATION_USE_ARRAY_OPTIMIZATION(fiberloom::CheckpointArchive)

#endif
