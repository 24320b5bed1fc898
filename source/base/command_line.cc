// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/command_line.h>
#include <fiberloom/base/exceptions.h>

#include <boost/program_options.hpp>

#include <ostream>

namespace fiberloom
{
  namespace
  {
    namespace po = boost::program_options;

    po::options_description
    visible_options()
    {
      const auto              text = [] { return po::value<std::string>(); };
      po::options_description options("Options");
      options.add_options()("set",
                            po::value<std::vector<std::string>>()->value_name(
                              "\"Section/Entry=value\""),
                            "override one entry of the file; repeatable")(
        "output-directory",
        text()->value_name("DIR"),
        "override the entry 'Output directory'; created if absent")(
        "restart",
        text()->value_name("FILE"),
        "continue from a checkpoint, or start the stages of this file from "
        "another run's last state")(
        "check",
        "read and check everything, print the size of the model, compute and "
        "write nothing")(
        "print-parameters",
        "print every parameter with its default, or with a file the values in "
        "force, as a valid file")("print-reference",
                                  "print tables of all parameters in markdown")(
        "help", "print this text")(
        "version", "print the version of the program and of its libraries");
      return options;
    }

    po::variables_map
    parse_options(const int argc, const char *const *argv)
    {
      po::options_description options = visible_options();
      options.add_options()("file", po::value<std::string>());
      po::positional_options_description positions;
      positions.add("file", 1);

      // no abbreviations: a misspelt option must not do something else
      const int style = po::command_line_style::unix_style &
                        ~po::command_line_style::allow_guessing;
      po::variables_map values;
      po::store(po::command_line_parser(argc, argv)
                  .options(options)
                  .positional(positions)
                  .style(style)
                  .run(),
                values);
      return values;
    }

    std::string
    text_of(const po::variables_map &values, const std::string &option)
    {
      if (values.count(option) == 0)
        return "";
      const std::string text = values[option].as<std::string>();
      if (text.empty())
        throw InputError("option --" + option + " is empty");
      return text;
    }
  } // namespace

  CommandLine
  CommandLine::parse(const int argc, const char *const *argv)
  {
    CommandLine command_line;
    try
      {
        const po::variables_map values = parse_options(argc, argv);
        command_line.file              = text_of(values, "file");
        command_line.restart           = text_of(values, "restart");
        command_line.check             = values.count("check") > 0;
        command_line.print_parameters  = values.count("print-parameters") > 0;
        command_line.print_reference   = values.count("print-reference") > 0;
        command_line.help              = values.count("help") > 0;
        command_line.version           = values.count("version") > 0;
        if (values.count("set") > 0)
          command_line.overrides = values["set"].as<std::vector<std::string>>();
        if (values.count("output-directory") > 0)
          command_line.overrides.push_back("Output directory=" +
                                           text_of(values, "output-directory"));
      }
    catch (const po::error &error)
      {
        throw InputError("command line: " + std::string(error.what()) +
                         "; allowed options are listed by --help");
      }

    const bool needs_file =
      !(command_line.print_parameters || command_line.print_reference ||
        command_line.help || command_line.version);
    if (needs_file && command_line.file.empty())
      throw InputError("command line: no parameter file; usage: fiberloom "
                       "FILE.prm [options], see --help");
    return command_line;
  }

  void
  CommandLine::print_help(std::ostream &out)
  {
    out << "Usage: fiberloom FILE.prm [options]\n"
           "       mpirun -np N fiberloom FILE.prm [options]\n\n"
           "Simulates woven textiles at the scale of their fibers, as FILE.prm "
           "describes.\nUnits: mm, N, MPa.\n\n"
        << visible_options()
        << "\nExit status: 0 all stages reached their end, 1 bad input, "
           "2 a stage did not\nconverge, 3 stopped on request with a "
           "checkpoint on disk.\n";
  }
} // namespace fiberloom
