// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// Every bad parameter file and command line gets one line that names the place
// and the entry, and says what is allowed.

#include <fiberloom/base/command_line.h>
#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/fabric/fabric_parameters.h>

#include <fiberloom/stages/stage.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>

using namespace fiberloom;

using Words = std::vector<std::string>;

unsigned int n_wrong = 0;

void
expect_error(const std::string           &what,
             const std::function<void()> &read,
             const Words                 &expected)
{
  std::string message;
  try
    {
      read();
      message = "no error";
    }
  catch (const InputError &error)
    {
      message = error.what();
    }
  bool good = message.find('\n') == std::string::npos;
  for (const std::string &word : expected)
    good = good && message.find(word) != std::string::npos;
  if (!good)
    ++n_wrong;
  std::cout << (good ? "" : "WRONG ") << what << " -> " << message << std::endl;
}

void
read_all(const std::string &file, const Words &overrides)
{
  Parameters parameters = Parameters::parse(file, overrides);
  resolve_fabric(parameters);
  parameters.check_stage_order({}, 0);
  const FiberSet  fibers = build_fiber_set(parameters);
  const FiberMesh mesh(fibers);
  for (const std::string &stage : parameters.stages)
    create_stage(stage, {parameters, fibers, mesh});
}

unsigned int
check_files()
{
  struct Case
  {
    std::string text;
    Words       expected;
  };
  const std::string warp         = "subsection Fabric\nsubsection Warp\n",
                    fill         = "subsection Fabric\nsubsection Fill\n",
                    ends         = "\nend\nend\n";
  const std::string       matrix = "subsection Matrix\nset Layers = both\n";
  const std::string       drive  = "set Stages = load\nset Drives = d\n"
                                   "subsection Fibers\n"
                                   "set Polylines = 0 0 0, 1 0 0\nend\n"
                                   "subsection Drive d\n";
  const std::string       lines  = "set Stages = load\nset Drives = d\n"
                                   "subsection Drive d\nset Ends = 0 start\nend\n"
                                   "subsection Fibers\nset Polylines = ";
  const std::string       line_8 = "line 7: Fibers/Polylines";
  const std::string       fibers = "set Stages = load\nset Drives = d\n"
                                   "subsection Drive d\nset Ends = 0 start\nend\n"
                                   "subsection Fibers\n";
  const std::vector<Case> cases  = {
     {"set Accurracy = fine\n", {"line 1", "Accurracy", "is Accuracy meant"}},
     {"# one\n\nset A = 1 # two\n", {"line 3", "entry A"}},
     {"subsection Febric\nend\n", {"line 1", "Febric", "Fabric, "}},
     {"subsection Fabric\nset Tow spacing = 1\nend\n",
      {"line 2", "Fabric/Tow spacing", "Fabric/Warp/Tow spacing meant"}},
     {"subsection Fabric\nsubsection Weft\nend\nend\n",
      {"line 2", "Fabric/Weft", "Fill, Warp"}},
     {"subsection Drive tip\nend\n", {"line 1", "Drive tip", "Drives"}},
     {"set Accuracy = coarse\n", {"line 1", "Accuracy = coarse", "draft"}},
     {"set Accuracy = 2\n", {"line 1", "Accuracy = 2 is", "such as 2 %"}},
     {"set Accuracy = 0.1 %\n", {"line 1", "0.1 %", "from 0.2 % to 20 %"}},
     {"set Accuracy = 21%\n", {"line 1", "21%", "from 0.2 % to 20 %"}},
     {"set Accuracy = -2 %\n", {"line 1", "-2 %", "from 0.2 % to 20 %"}},
     {"set Accuracy = nan %\n", {"line 1", "nan %", "such as 2 %"}},
     {"set Accuracy = %\n", {"line 1", "Accuracy = %", "such as 2 %"}},
     {"set Accuracy = 2 3 %\n", {"line 1", "2 3 %", "such as 2 %"}},
     {"set Accuracy =\n", {"line 1", "Accuracy", "such as 2 %"}},
     {"set Maximal wall time = -1\n", {"line 1", "Maximal wall time", "0"}},
     {warp + "set Tows = four" + ends, {"line 3", "Warp/Tows = four", "whole"}},
     {warp + "set Tows = 1000\nset Fibers per tow = 10000" + ends,
      {"line 3: Fabric/Warp/Tows", "nodes", "at most 2000000"}},
     {"subsection Fabric\nset Periodic = true\nset Plies = 100\nsubsection Warp\n"
       "set Fibers per tow = 100" +
        ends,
      {"Fabric/Fill/Tows", "Plies", "nodes", "at most 2000000"}},
     {fill + "set Overhang = 1e9" + ends,
      {"line 3: Fabric/Fill/Overhang", "10000 elements"}},
     {matrix + "set Cells along x = 1000\nset Cells along y = 1000\nend\n",
      {"line 3: Matrix/Cells along x", "at most 2000000"}},
     {fibers + "set Curves = s; i; 0\nset Fibers per curve = 10000\n"
                "set Elements per fiber = 1000\nend\n",
      {"line 9: Fibers/Elements per fiber", "more than 2000000 nodes"}},
     {warp + "set Tows = 0" + ends, {"line 3", "Fabric/Warp/Tows", "from 1"}},
     {warp + "set Tows = 2.5" + ends, {"line 3", "Fabric/Warp/Tows", "whole"}},
     {warp + "set Tows = 99999999999" + ends, {"line 3", "to 1000"}},
     {warp + "set Fibers per tow = -7" + ends, {"line 3", "Fibers per tow"}},
     {warp + "set Fiber radius = 0" + ends, {"line 3", "Fiber radius", "above"}},
     {warp + "set Fiber radius = nan" + ends, {"line 3", "Fiber radius"}},
     {warp + "set Fiber radius = 1e400" + ends, {"line 3", "Fiber radius"}},
     {fill + "set Fiber radius = 8 um" + ends, {"line 3", "Fill/Fiber radius"}},
     {warp + "set Young modulus = -1" + ends, {"line 3", "Young modulus"}},
     {fill + "set Young modulus = 0" + ends, {"line 3", "Young modulus"}},
     {warp + "set Poisson ratio = .5" + ends,
      {"line 3", "Poisson", "below 0.5"}},
     {warp + "set Poisson ratio = -.1" + ends, {"line 3", "Poisson ratio"}},
     {warp + "set Elements per fiber = -1" + ends, {"line 3", "Elements"}},
     {warp + "set Layers = 2, 2, 2" + ends, {"line 3", "Warp/Layers", "7"}},
     {warp + "set Layers = 4, -1, 4" + ends, {"line 3", "Warp/Layers"}},
     {warp + "set Fiber spacing = 1.9" + ends,
      {"line 3", "Warp/Fiber spacing", "at least 2"}},
     {warp + "set Tow spacing = 0.04" + ends,
      {"line 3", "Warp/Tow spacing", "overlap", "at least"}},
     {fill + "set Fibers per tow = 400" + ends, {"Fill/Tow spacing", "overlap"}},
     {fill + "set Overhang = 0.01" + ends, {"line 3", "Fill/Overhang", "least"}},
     {"subsection Fabric\nset Pattern = herringbone\nend\n",
      {"line 2", "Fabric/Pattern", "herringbone", "plain"}},
     {"subsection Fabric\nset Pattern = 1010 010 1010 0101\nend\n",
      {"line 2", "Fabric/Pattern", "differ in length"}},
     {"subsection Fabric\nset Pattern = 101 010 101\nend\n",
      {"line 2", "Fabric/Pattern", "3 rows of 3", "4"}},
     {"set Stages = weave, knit\n", {"line 1", "Stages", "knit", "relax"}},
     {"set Stages =\n", {"line 1", "Stages", "empty"}},
     {"set Stages = relax, weave\n", {"line 1", "Stages", "weave first"}},
     {"set Stages = biaxial\n", {"line 1", "Stages", "biaxial", "weave first"}},
     {"set Stages = weave, relax, weave\n", {"line 1", "Stages", "once"}},
     {"set Stages = weave, load\n", {"line 1", "Stages", "drives"}},
     {"set Output directory =\n", {"line 1", "Output directory", "empty"}},
     {"set Drives = a, a\n", {"line 1", "Drives", "twice"}},
     {"set Drives = a/b\n", {"line 1", "Drives", "a/b", "letters"}},
     {"subsection Contact\nset Friction coefficient = -.1\nend\n",
      {"line 2", "Contact/Friction coefficient", "at least 0"}},
     {"subsection Contact\nset Largest penetration = 1\nend\n",
      {"line 2", "Contact/Largest penetration", "below 1"}},
     {"subsection Biaxial\nset Strain ratio = inf\nend\n",
      {"line 2", "Biaxial/Strain ratio"}},
     {"subsection Biaxial\nset Largest strain = 0\nend\n",
      {"line 2", "Biaxial/Largest strain"}},
     {"subsection Biaxial\n\nset Strain ratio = 1\n",
      {"line 1", "Biaxial", "no 'end'"}},
     {"subsection Biaxial\nend\nend\n", {"line 3", "'end'"}},
     {"weave it\n", {"line 1", "set ENTRY = VALUE"}},
     {"include other.prm\n", {"line 1", "include"}},
     {"set Stages = weave, \\\n  relax, \\\n  knit\n", {"line 1", "Stages"}},
     {drive + "end\n", {"Drive d/Ends", "no end"}},
     {drive + "set Ends = 0 begin\nend\n", {"line 7", "Ends", "0 begin"}},
     {drive + "set Ends = 1 end\nend\n", {"line 7", "Ends", "no fiber for 1"}},
     {drive + "set Ends = 0 end, 0 end\nend\n", {"line 7", "Ends", "twice"}},
     {drive + "set Ends = 0 end, all end\nend\n", {"line 7", "Ends", "twice"}},
     {drive + "set Ends = 0 at 1.5\nend\n", {"line 7", "Ends", "from 0 to 1"}},
     {drive + "set Ends = 0-3 end\nend\n", {"line 7", "no fiber for 0-3"}},
     {drive + "set Ends = 0 end, 0 at 0.98\nend\n", {"at 0.98", "twice"}},
     {drive + "set Ends = end\nend\n", {"line 7", "names nothing", "3-5 end"}},
     {drive + "set Ends = warp start\nend\n", {"line 7", "there is no warp"}},
     {drive + "set Ends = 0 end\nset Held = x w\nend\n",
      {"line 8", "Held", "w cannot be held", "spin"}},
     {drive + "set Ends = 0 end\nset Center = 1 2\nend\n",
      {"line 8", "Center", "three numbers"}},
     {drive + "set Ends = 0 end\nset Translation = 0; 0; 1+t\nend\n",
      {"line 8", "Translation", "not 0 at t = 0"}},
     {drive + "set Ends = 0 end\nset Rotation = if(t<0.5,0,3); 0; 0\nend\n",
      {"line 8", "Rotation", "jumps"}},
     {drive + "set Ends = 0 end\nset Rotation = sqrt(0.5-t); 0; 0\nend\n",
      {"line 8", "Rotation", "not finite at t = 0.5005"}},
     {drive + "set Ends = 0 end\nend\nsubsection Load\n"
               "set Gravity = 0; 0; -9810\nend\n",
      {"line 10", "Gravity", "Fibers/Density"}},
     {drive + "set Ends = 0 end\nend\nsubsection Load\n"
               "set Line load = 1; 0\nend\n",
      {"line 10", "Line load", "2 functions"}},
     {drive + "set Ends = 0 end\nend\nsubsection Load\n"
               "set Loaded fibers = 1\nend\n",
      {"line 10", "Loaded fibers", "no fiber for 1"}},
     {drive + "set Ends = 0 end\nend\nsubsection Load\n"
               "set Probes = 0 middle\nend\n",
      {"line 10", "Probes", "0 middle", "0 start"}},
     {drive + "set Ends = 0 end\nset Held = x y spin\nset Free = z\nend\n",
      {"line 9", "Free", "motion along z"}},
     {drive + "set Ends = 0 end\nset Hold = pinned\nset Free = ry\nend\n",
      {"line 9", "Free", "motion along ry"}},
     {drive + "set Ends = 0 end\nset Held = x y z radial\nend\n",
      {"line 8", "Held", "reference point", "Center"}},
     {drive + "set Ends = 0 end\nset Free = xy\nend\n",
      {"line 8", "Free", "xy"}},
     {drive + "set Ends = 0 end\nset Hold = glued\nend\n",
      {"line 8", "Hold = glued", "clamped"}},
     {drive + "set Ends = 0 end\nset Translation = 0; t\nend\n",
      {"line 8", "Translation", "2 functions"}},
     {drive + "set Ends = 0 end\nset Force = 0; 0; 1e-6*rand()*t\nend\n",
      {"line 8", "Force", "rand", "do not repeat"}},
     {fibers + "set Curves = s; rand_seed(1); 0\nend\n",
      {"line 7: Fibers/Curves", "rand_seed", "do not repeat"}},
     {drive + "set Ends = 0 end\nset Translation = 0; 0; foo*t\nend\n",
      {"line 8", "Translation", "foo"}},
     {drive + "set Ends = 0 end\nset Force = 0; 0; t\nend\n",
      {"line 8", "Force", "z is not free"}},
     {drive + "set Ends = 0 end\nset Free = rx\nset Rotation = t; 0; 0\nend\n",
      {"line 9", "Rotation", "rx is free"}},
     {"set Stages = weave, coat\n", {"line 1", "Stages", "Matrix/Layers"}},
     {matrix + "set Young modulus = 0\nend\n",
      {"line 3", "Matrix/Young modulus", "above 0"}},
     {matrix + "set Poisson ratio = 0.5\nend\n",
      {"line 3", "Matrix/Poisson ratio", "below 0.5"}},
     {matrix + "set Overlap = 0.05\nset Thickness = 0.04\nend\n",
      {"line 4", "Matrix/Thickness", "overlap", "0.05"}},
     {matrix + "set Thickness = 1e308\nend\n",
      {"line 3", "Matrix/Thickness", "1e+06"}},
     {matrix + "set Degree = 3\nend\n", {"line 3", "Matrix/Degree"}},
     {matrix + "set Law = rubber\nend\n", {"line 3", "Matrix/Law", "neo-Hooke"}},
     {drive + "set Matrix borders = x start\nend\n",
      {"line 7", "Matrix borders", "no matrix"}},
     {drive + "set Matrix borders = left\nend\n",
      {"line 7", "no border left", "x start"}},
     {drive + "set Ends = 0 end\nset Matrix held = u\nend\n",
      {"line 8", "Matrix held", "u cannot"}},
     {"subsection Shear\nset Largest angle = 0\nend\n",
      {"line 2", "Shear/Largest angle"}},
     {"subsection Bending\nset Direction = up\nend\n",
      {"line 2", "Bending/Direction", "warp"}},
     {lines + "0 0 0\nend\n", {line_8, "1 points"}},
     {lines + "0 0 0, 1 0\nend\n", {line_8, "three numbers"}},
     {lines + "0 0 0, 1 0 nan\nend\n", {line_8, "three numbers"}},
     {lines + "0 0 0, 1 0 0 0\nend\n", {line_8, "three numbers"}},
     {lines + "0 0 0, 1 0 0; 0 0 1, 0 0 1\nend\n",
      {line_8, "line number 1", "same"}},
     {lines + "0 0 0, 1 0 0, 0 0 0\nend\n", {line_8, "folds back"}},
     {lines + "0 0 0, 1 0 0\nset Radius = 0\nend\n",
      {"line 8", "Fibers/Radius"}},
     {lines + "0 0 0, 1 0 0\nend\nset Stages = weave\n",
      {"line 9", "Stages", "weave needs a fabric"}},
     {lines + "0 0 0, 1 0 0\nset Curves = s; 0; 0\nend\n",
      {"line 8: Fibers/Curves", "Polylines is given, too"}},
     {lines + "0 0 0, 1 0 0\nset Radius = 0.1, 0.2\nend\n",
      {"line 8: Fibers/Radius", "2 values", "allowed: 1"}},
     {lines + "0 0 0, 1 0 0\nset Radius = 0.1, -0.2\nend\n",
      {"line 8: Fibers/Radius", "above 0"}},
     {lines + "0 0 0, 1 0 0\nset Young modulus =\nend\n",
      {"line 8: Fibers/Young modulus", "above 0"}},
     {lines + "0 0 0, 1 0 0; 0 1 0, 1 1 0; 1 0.0005 0, 0 0.0005 0\nend\n",
      {line_8, "fibers 0 and 2 lie in each other", "allowed"}},
     {lines + "0 0 0, 1 0 0\nset Interpolation = round\nend\n",
      {"line 8: Fibers/Interpolation", "straight, smooth"}},
     {lines + "0 0 0, 1 0 0\nset Stress free = bent\nend\n",
      {"line 8: Fibers/Stress free", "as given, straight"}},
     {lines + "0 0 0, 1 0 0, 0 0.1 0\nset Interpolation = smooth\nend\n",
      {line_8, "right angle", "more elements"}},
     {lines + "0 0 0, 0.01 0 0, 0.01 0.01 0\nend\n",
      {line_8, "bends with a radius", "allowed: more than", "0.01"}},
     {fibers + "set Curves = s; 0\nend\n",
      {"line 7: Fibers/Curves", "curve number 0", "2 functions"}},
     {fibers + "set Curves = s; 0; 0 | s; foo; 1\nend\n",
      {"line 7: Fibers/Curves", "curve number 1", "foo"}},
     {fibers + "set Curves = 1/s; 0; 0\nend\n",
      {"line 7: Fibers/Curves", "not finite", "s from 0 to 1"}},
     {fibers + "set Curves = i; 0; 0\nend\n",
      {"line 7: Fibers/Curves", "no length"}},
     {fibers + "set Curves = s^2; 0; 0\nend\n",
      {"line 7: Fibers/Curves", "stands still at s = 0"}},
     {fibers + "set Curves = s; 0; 0\nset Fibers per curve = 2\nend\n",
      {"line 7: Fibers/Curves", "0 and 1 lie in each other"}},
     {fibers + "set Curves = s; i; 0\nset Fibers per curve = 2, 3\nend\n",
      {"line 8: Fibers/Fibers per curve", "2 numbers", "curves, 1"}},
     {fibers + "set Curves = 0.02*cos(3*s); 0.02*sin(3*s); 0\n"
                "set Radius = 0.02\nend\n",
      {"line 7: Fibers/Curves", "bends with a radius of", "0.02"}},
     {fibers + "set Curves = 0.02*cos(3*s); 0.02*sin(3*s); 0\n"
                "set Radius = 0.02\nset Stress free = straight\nend\n",
      {"line 7: Fibers/Curves", "bends with a radius of", "0.02"}},
     {fibers + "set Arrangement = bundle\nset Strength = 1000\n"
                "set Breaking strain = 0.02\nend\n",
      {"line 8: Fibers/Strength", "Breaking strain is given, too"}},
     {fibers + "set Arrangement = bundle\nset Strength = 1000\n"
                "set Weibull modulus = 5\nend\n",
      {"line 9: Fibers/Weibull modulus", "Reference length"}},
     {fibers + "set Arrangement = braid\nend\n",
      {"line 7: Fibers/Arrangement = braid", "bundle"}},
     {fibers + "set Arrangement = bundle\nsubsection Bundle\n"
                "set Fibers = 12\nend\nend\n",
      {"line 9: Fibers/Bundle/Fibers", "7 or 19"}},
     {fibers + "set Arrangement = bundle\nsubsection Bundle\n"
                "set Spacing = 1.9\nend\nend\n",
      {"line 9: Fibers/Bundle/Spacing", "at least 2"}},
     {fibers + "set Arrangement = strand\nend\n",
      {"Fibers/Strand/Lay angle", "neither", "one of them"}},
     {fibers + "set Arrangement = strand\nsubsection Strand\n"
                "set Lay angle = 0.1\nset Lay length = 1\nend\nend\n",
      {"line 9: Fibers/Strand/Lay angle", "too", "one of them"}},
     {fibers + "set Arrangement = strand\nsubsection Strand\n"
                "set Lay angle = 0.1\nset Outer fibers = 7\nend\nend\n",
      {"line 10: Fibers/Strand/Outer fibers", "at most 6"}},
     {fibers + "set Arrangement = strand\nset Radius = 1, 2, 3\n"
                "subsection Strand\nset Lay angle = 0.1\nend\nend\n",
      {"line 8: Fibers/Radius", "3 values", "1 or 2"}},
     {fibers + "set Arrangement = strand\nset Radius = 0.01\n"
                "subsection Strand\nset Lay length = 0.01\nend\nend\n",
      {"line 7: Fibers/Arrangement", "outer fiber", "right angle"}}};

  for (const Case &bad : cases)
    {
      std::ofstream("bad.prm") << bad.text;
      Words expected = bad.expected;
      expected.push_back("bad.prm");
      std::string shown = bad.text;
      std::replace(shown.begin(), shown.end(), '\n', '|');
      expect_error(
        shown, [] { read_all("bad.prm", {}); }, expected);
    }
  return cases.size();
}

/** Lines as long as no user writes them, and one line in answer. */
unsigned int
check_long_lines()
{
  const std::string                                many(200000, '1');
  const std::vector<std::pair<std::string, Words>> cases = {
    {"#" + many + "\nset Accurracy = fine\n", {"line 2", "Accuracy meant"}},
    {"set Accuracy = " + many + "\n", {"line 1", " ... ", "draft"}},
    {"set " + many + " = 1\n", {"line 1", " ... ", "--print-parameters"}},
    {"subsection " + many + "\nend\n", {"line 1", "section", "Fabric"}},
    {many, {"line 1", "set ENTRY = VALUE"}},
    {"set Drives = a" + many, {"Drive a1", "Ends"}},
    {"set Stages = load\nset Drives = d\nsubsection Fibers\nset Polylines = "
     "0 0 0, 1 0 0\nend\nsubsection Drive d\nset Ends = " +
       many + " start\nend\n",
     {"line 7: Drive d/Ends", "allowed"}}};
  for (const auto &[text, expected] : cases)
    {
      std::ofstream("bad.prm") << text;
      const auto read = [] {
        try
          {
            read_all("bad.prm", {});
          }
        catch (const InputError &error)
          {
            throw InputError(one_line(error));
          }
      };
      expect_error("long line, " + text.substr(0, 20), read, expected);
    }
  return cases.size();
}

/** Files of fibers, each named by a scene in the same directory. */
unsigned int
check_fiber_files()
{
  const std::string head = "fiber,x,y,z,radius\n", row = "0,0,0,0,0.1\n",
                    vtp = "<VTKFile type=\"PolyData\"><PolyData><Piece "
                          "NumberOfPoints=\"1\" NumberOfVerts=\"1\"><Points>"
                          "<DataArray type=\"Float64\" format=\"ascii\" "
                          "NumberOfComponents=\"3\">1 2 3</DataArray></Points>"
                          "<Verts><DataArray type=\"Int64\" format=\"ascii\" "
                          "Name=\"connectivity\">0</DataArray><DataArray "
                          "type=\"Int64\" format=\"ascii\" Name=\"offsets\">1"
                          "</DataArray></Verts></Piece></PolyData></VTKFile>";
  struct Case
  {
    std::string name, text;
    Words       expected;
  };
  const std::vector<Case> cases = {
    {"f.csv", "", {"empty", "header"}},
    {"f.csv", "fiber,x,y\n", {"line 1", "no column z"}},
    {"f.csv", "fiber,x,y,z,r\n", {"no fibers"}},
    {"f.csv", "fiber,x[in],y,z\n", {"line 1", "x[in]", "unit", "mm, m, "}},
    {"f.csv", "fiber,x[mm,y,z\n", {"line 1", "x[mm", "does not end"}},
    {"f.csv", "fiber,x[mm],x[um],y,z\n", {"line 1", "two columns x"}},
    {"f.csv",
     "fiber,x,y,z,young_modulus[mm]\n",
     {"line 1", "young_modulus[mm]", "GPa"}},
    {"f.csv", head + "-1,0,0,0,1\n", {"line 2", "fiber = -1", "here 0"}},
    {"f.csv", head + "0,0,0,0,1e300\n0,1,0,0,1e300\n", {"fiber 0", "radius"}},
    {"f.csv", head + "0,0,0,0,1e-300\n0,1,0,0,1e-300\n", {"fiber 0", "lost"}},
    {"f.csv", head + "0,1e300,0,0,1\n0,1,0,0,1\n", {"fiber 0", "farther"}},
    {"f.csv", std::string(2000000, 'x'), {"line 1", "longer than 1000000"}},
    {"f.csv", head + std::string(3, '\0'), {"line 2", "1 values"}},
    {"f.csv", "fiber,x,y,z,x\n", {"line 1", "two columns x"}},
    {"f.csv", head, {"no fibers"}},
    {"f.csv", head + row + "0,1,0,0\n", {"line 3", "4 values", "5"}},
    {"f.csv", head + row + "0,one,0,0,1\n", {"line 3", "x = one", "number"}},
    {"f.csv", head + row + "0,nan,0,0,1\n", {"line 3", "x = nan", "number"}},
    {"f.csv", head + row + "0,1,,0,1\n", {"line 3", "y = ", "number"}},
    {"f.csv", head + row, {"fiber 0", "1 points", "two or more"}},
    {"f.csv", head + row + row, {"fiber 0", "points 0 and 1 are the same"}},
    {"f.csv", head + row + "2,1,0,0,1\n", {"line 3", "fiber = 2", "0 or 1"}},
    {"f.csv", head + "1,0,0,0,1\n", {"line 2", "fiber = 1", "here 0"}},
    {"f.csv", head + row + "0,1,0,0,2\n", {"line 3", "radius changes"}},
    {"f.csv", head + "0,0,0,0,0\n0,1,0,0,0\n", {"fiber 0", "radius = 0"}},
    {"f.csv",
     "fiber,x,y,z,poisson_ratio\n0,0,0,0,0.5\n0,1,0,0,0.5\n",
     {"fiber 0", "poisson_ratio = 0.5", "below 0.5"}},
    {"f.csv",
     head + row + "0,1,0,0,0.1\n1,0,0,0,0.1\n1,2,0,0,0.1\n",
     {"fibers 0 and 1 lie in each other"}},
    {"f.txt", head, {"no known kind", ".csv"}},
    {"f.vtp", head, {"damaged", "XML"}},
    {"f.vtu", vtp, {"damaged", "XML"}},
    {"f.vtp", vtp, {"NumberOfVerts = 1", "no lines"}}};
  for (const Case &bad : cases)
    {
      std::ofstream(bad.name) << bad.text;
      std::ofstream("bad.prm")
        << "set Stages = load\nset Drives = d\n"
           "subsection Drive d\nset Ends = 0 start\nend\n"
           "subsection Fibers\nset File = "
        << bad.name << "\nend\n";
      Words expected = bad.expected;
      expected.insert(expected.end(),
                      {"bad.prm, line 7: Fibers/File", bad.name});
      std::string shown = bad.text;
      std::replace(shown.begin(), shown.end(), '\n', '|');
      expect_error(
        shown, [] { read_all("bad.prm", {}); }, expected);
    }
  expect_error("missing file of fibers",
               [] { read_all("bad.prm", {"Fibers/File=no_such.csv"}); },
               {"--set", "no_such.csv", "No such file"});
  expect_error("directory as file of fibers",
               [] { read_all("bad.prm", {"Fibers/File=."}); },
               {"--set", "directory"});
  return cases.size() + 2;
}

/** Damages of a file of VTK, each found before what is wrong is used. */
unsigned int
check_vtk_files()
{
  const std::string good =
    "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\n"
    "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n"
    "<PointData><DataArray type=\"Float64\" Name=\"radius\">1 1 1"
    "</DataArray></PointData>\n"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">"
    "0 0 0 5 0 0 9 0 0</DataArray></Points>\n<Cells>"
    "<DataArray type=\"Int64\" Name=\"connectivity\">0 1 2</DataArray>"
    "<DataArray type=\"Int64\" Name=\"offsets\">3</DataArray>"
    "<DataArray type=\"UInt8\" Name=\"types\">4</DataArray>"
    "</Cells></Piece></UnstructuredGrid></VTKFile>";
  struct Case
  {
    std::string from, to;
    Words       expected;
  };
  std::string deep;
  for (unsigned int i = 0; i < 100000; ++i)
    deep += "<a>";
  const std::vector<Case> cases = {
    {"0 1 2<", "0 1 1000000000000<", {"connectivity", "0 to 2"}},
    {"0 1 2<", "0 -1000000000000 2<", {"connectivity", "0 to 2"}},
    {"0 1 2<", "0 1 2.5<", {"connectivity", "0 to 2"}},
    {"0 1 2<", "0 1 nan<", {"connectivity", "0 to 2"}},
    {"0 1 2<", "0 1<", {"connectivity", "2 numbers; allowed: 3"}},
    {"0 1 2<", "0 1 2 2<", {"connectivity", "more than 3"}},
    {">3<", ">0<", {"offsets", "cell 0 goes from 0 to 0"}},
    {">3<", ">-1<", {"offsets", "out of range"}},
    {">3<", ">4<", {"connectivity", "3 numbers; allowed: 4"}},
    {">3<", ">10000000<", {"connectivity", "3 numbers; allowed: 10000000"}},
    {">4<", ">255<", {"cell 0", "type 255", "lines"}},
    {">4<", ">5<", {"cell 0", "type 5"}},
    {"Cells=\"1\"", "Cells=\"-1\"", {"NumberOfCells = -1"}},
    {"Cells=\"1\"", "Cells=\"9000000000\"", {"NumberOfCells", "10000000"}},
    {"Cells=\"1\"", "Cells=\"0\"", {"no fibers"}},
    {"Points=\"3\"", "Points=\"0\"", {"no points"}},
    {"Points=\"3\"", "Points=\"10000000\"", {"allowed: 30000000"}},
    {"<Points>", deep, {"damaged", "within 30 others"}},
    {"<Points>", "<Points><Points>", {"damaged", "ends where Points is open"}},
    {"<Points>", "<Points a=\"\" a=\"\">", {"damaged", "line 4", "too many"}},
    {"<Points>", "<Points a=b>", {"damaged", "line 4", "quotes"}},
    {"<Points>", "<!-- ", {"damaged", "-->"}},
    {"radius", "radius[in]", {"radius[in]", "unit"}},
    {"Float64", "String", {"radius", "type String", "numbers"}},
    {"1 1 1", "1 1 one", {"radius", "\"one\""}},
    {"1 1 1", "1 1 2", {"fiber 0", "radius changes"}},
    {"1 1 1", "1e300 1e300 1e300", {"fiber 0", "larger than its length"}},
    {"1 1 1", "nan nan nan", {"fiber 0", "radius changes"}},
    {"Name=\"radius\"",
     "Name=\"radius\" NumberOfComponents=\"2\"",
     {"2 components"}},
    {"Name=\"radius\"",
     "Name=\"radius\" format=\"binary\"",
     {"radius", "truncated"}},
    {"Name=\"radius\"",
     "Name=\"radius\" format=\"appended\" offset=\"1\"",
     {"offset = 1"}},
    {"</PointData>",
     "<DataArray Name=\"radius\" type=\"Float64\">1 1 1</DataArray>"
     "</PointData>",
     {"two arrays radius"}},
    {"0 0 0 5", "0 0 1e300 5", {"fiber 0", "farther"}},
    {"0 0 0 5", "0 0 inf 5", {"fiber 0", "point 0 is not finite"}}};
  for (const Case &bad : cases)
    {
      std::string text = good;
      text.replace(text.find(bad.from), bad.from.size(), bad.to);
      std::ofstream("f.vtu") << text;
      std::ofstream("bad.prm") << "set Stages = load\nset Drives = d\n"
                                  "subsection Drive d\nset Ends = 0 start\n"
                                  "end\nsubsection Fibers\n"
                                  "set File = f.vtu\nend\n";
      Words expected = bad.expected;
      expected.push_back("bad.prm, line 7: Fibers/File");
      expect_error(
        "VTK: " + bad.from + " -> " + bad.to.substr(0, 30),
        [] { read_all("bad.prm", {}); },
        expected);
    }
  return cases.size();
}

/** What is no file, or none to be read, and what would steer a terminal. */
unsigned int
check_odd_files()
{
  const std::string steering = "\x1b[31m\xc2\x9b\xe2\x80\xa8\xff";
  std::filesystem::remove("loop.prm");
  std::filesystem::create_symlink("loop.prm", "loop.prm");
  std::ofstream("empty.prm") << "# nothing\n";
  std::ofstream("bad.prm") << "set " + steering + " = 1\n";
  std::string nested;
  for (unsigned int i = 0; i < 30000; ++i)
    nested += "subsection A\n";
  std::ofstream("nested.prm") << nested;
  expect_error("loop of links",
               [] { read_all("loop.prm", {}); },
               {"loop.prm", "symbolic links"});
  expect_error("device", [] { read_all("/dev/zero", {}); }, {"no regular"});
  expect_error("nothing set",
               [] { read_all("empty.prm", {}); },
               {"empty.prm", "sets no entry"});
  expect_error("30,000 sections",
               [] { read_all("nested.prm", {}); },
               {"nested.prm, line 11", "within 10 others"});
  expect_error("control characters",
               [] {
                 try
                   {
                     read_all("bad.prm", {});
                   }
                 catch (const InputError &error)
                   {
                     throw InputError(one_line(error));
                   }
               },
               {"entry \\x1b[31m\\xc2\\x9b\\xe2\\x80\\xa8\\xff;"});
  return 5;
}

unsigned int
check_overrides()
{
  std::ofstream("good.prm") << "set Accuracy = standard\n";
  const std::vector<std::pair<std::string, Words>> cases = {
    {"No such section/Entry=1", {"No such section/Entry"}},
    {"Fabric/Warp/Towss=4", {"Fabric/Warp/Tows meant"}},
    {"Fabric/Warp/Tows", {"Section/Entry=value"}},
    {"Fabric/Warp/Tows=-4", {"Fabric/Warp/Tows = -4", "from 1"}},
    {"Fabric/Warp/Tows=1=2", {"Fabric/Warp/Tows = 1=2"}},
    {"Fabric/Warp/Layers=3", {"Fabric/Warp/Layers", "7"}},
    {"=1", {"no entry"}},
    {"Drives=a", {"Drive a/Ends"}}};
  for (const auto &[text, expected] : cases)
    {
      Words all = expected;
      if (text != "Drives=a")
        all.push_back("--set \"" + text + "\"");
      expect_error(
        text, [text = text] { read_all("good.prm", {text}); }, all);
    }
  return cases.size();
}

unsigned int
check_missing_files()
{
  expect_error("missing file",
               [] { read_all("no_such_file.prm", {}); },
               {"no_such_file.prm", "No such file"});
  if (std::filesystem::exists("no_such_file.prm"))
    ++n_wrong;
  expect_error("directory", [] { read_all(".", {}); }, {"directory"});
  return 2;
}

unsigned int
check_command_lines()
{
  const std::vector<std::pair<std::vector<const char *>, Words>> cases = {
    {{"fiberloom"}, {"usage", "FILE.prm"}},
    {{"fiberloom", "--check"}, {"usage", "FILE.prm"}},
    {{"fiberloom", "a.prm", "b.prm"}, {"--help"}},
    {{"fiberloom", "a.prm", "--restar", "c"}, {"--restar", "--help"}},
    {{"fiberloom", "a.prm", "--restart"}, {"--restart", "--help"}},
    {{"fiberloom", "a.prm", "--set"}, {"--set", "--help"}},
    {{"fiberloom", "a.prm", "-x"}, {"-x", "--help"}},
    {{"fiberloom", "a.prm", "--output-directory", ""}, {"output-directory"}},
    {{"fiberloom", "a.prm", "--check", "--check"}, {"--check"}}};
  for (const auto &[arguments, expected] : cases)
    expect_error(
      arguments.back(),
      [arguments = arguments] {
        CommandLine::parse(arguments.size(), arguments.data());
      },
      expected);
  return cases.size();
}

int
main()
{
  dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
  unsigned int n_cases = check_files();
  n_cases += check_long_lines();
  n_cases += check_fiber_files();
  n_cases += check_vtk_files();
  n_cases += check_odd_files();
  n_cases += check_overrides();
  n_cases += check_missing_files();
  n_cases += check_command_lines();

  std::ofstream output("output");
  output << n_cases << " cases, " << n_wrong << " wrong" << std::endl;
}
