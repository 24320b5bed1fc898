// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_parameters_h
#define fiberloom_base_parameters_h

#include <fiberloom/base/accuracy.h>
#include <fiberloom/base/choices.h>
#include <fiberloom/base/drive_parameters.h>
#include <fiberloom/base/stage_type.h>
#include <fiberloom/base/strength_parameters.h>

#include <cmath>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace fiberloom
{
  class ParameterCatalogue;

  /**
   * One family of tows, warp or fill. Lengths in mm, moduli in MPa. A value
   * of zero for an entry marked "automatic" is resolved by
   * Parameters::resolve().
   */
  struct TowParameters
  {
    static constexpr unsigned int most_elements = 10000; // per fiber

    // For each tow that a fiber crosses: a quadratic element has one half wave.
    static constexpr unsigned int least_elements = 2;

    bool                      same_as_warp = false;
    unsigned int              tows         = 4;
    unsigned int              fibers       = 7;
    std::vector<unsigned int> layers;                // automatic when empty
    double                    fiber_radius  = 0.008; // [mm]
    double                    fiber_spacing = 2.06;  // over the radius
    double                    tow_spacing   = 0.24;  // [mm]
    double overhang = 0; // [mm], automatic: half a spacing of the crossing tows
    double young_modulus                  = 73000; // [MPa]
    double poisson_ratio                  = 0.22;
    double density                        = 0; // [t/mm^3]
    AxialLaw           axial_law          = AxialLaw::saint_venant_kirchhoff;
    unsigned int       elements_per_fiber = 0; // automatic
    StrengthParameters strength;

    /** Mean, where these tows cross @p crossing [mm]. */
    double
    element_length(const TowParameters &crossing) const
    {
      return ((crossing.tows - 1) * crossing.tow_spacing + 2 * overhang) /
             elements_per_fiber;
    }
  };

  /** A fabric woven from two families of tows. */
  struct FabricParameters
  {
    std::string         pattern  = "plain";
    bool                periodic = false;   // a cell without tow ends
    std::vector<double> cell_cut = {0, 0};  // along warp and fill, over the
                                            // spacing of the tows that cross
    unsigned int              plies = 1;    // of a cell
    std::vector<double>       ply_shift;    // over the periods, see the entry
    std::vector<unsigned int> ply_rotation; // quarter turns; empty: none
    TowParameters             warp;
    TowParameters             fill;

    /** Volume of the fibers of one ply over its area while flat [mm]. */
    double
    volume_over_area() const;
  };

  /** Straight parallel fibers along x, packed hexagonally. */
  struct BundleParameters
  {
    unsigned int fibers  = 7;
    double       length  = 1;    // [mm]
    double       spacing = 2.02; // over the radius
  };

  /** A straight core along x and the helices around it. */
  struct StrandParameters
  {
    unsigned int outer_fibers = 6;
    double       length       = 1; // of the core [mm]
    double       lay_angle    = 0; // [rad], 0: by the lay length
    double       lay_length   = 0; // [mm], 0: by the lay angle
  };

  /**
   * Fibers that do not form a fabric, from one of four sources: polylines,
   * a file, curves or an arrangement. Lists of values hold one for all fibers
   * or one for each group: a polyline, a curve, or core and outer fibers.
   */
  struct FibersParameters
  {
    std::string polylines; // "x y z, x y z; x y z, x y z" [mm]
    std::string file;
    std::string curves; // "x; y; z | x; y; z" [mm] functions of s and i
    std::vector<unsigned int> fibers_per_curve = {1};
    Arrangement               arrangement      = Arrangement::none;
    BundleParameters          bundle;
    StrandParameters          strand;
    Joining                   interpolation = Joining::automatic;
    StressFree                stress_free   = StressFree::as_given;
    std::vector<double>       radius        = {0.01};  // [mm]
    std::vector<double>       young_modulus = {73000}; // [MPa]
    std::vector<double>       poisson_ratio = {0.22};
    std::vector<double>       density       = {0}; // [t/mm^3]
    AxialLaw                  axial_law     = AxialLaw::saint_venant_kirchhoff;
    unsigned int              elements_per_fiber = 8;
    StrengthParameters        strength;

    /** The entries that say where fibers come from, of those given. */
    std::vector<std::string>
    sources() const;
  };

  /** Contact and friction between fibers. */
  struct ContactParameters
  {
    double friction_coefficient = 0.2;
    double largest_penetration  = 0; // over the radius; automatic: by accuracy
    double stations_per_element = 0; // automatic: by accuracy
    double initial_stiffness    = 0.2; // over E r
    double line_stiffness       = 0; // [N/mm^2], automatic: as penetration asks
    double elastic_slip         = 0.05; // over the radius
    double search_margin        = 0.3;  // over the radius
    SelfContact self_contact    = SelfContact::automatic;
  };

  /** How equilibrium is found, and how well. */
  struct SolverParameters
  {
    Loops  loops = Loops::newton;
    double contact_tolerance =
      0; // over the largest contact force; automatic: by accuracy
    double newton_tolerance =
      1e-8; // where there is no contact, over the internal forces
    double largest_move =
      0.5; // per Newton iteration, over the radius; 0: unlimited
    unsigned int    largest_contact_passes    = 12;
    unsigned int    largest_normal_passes     = 15;
    unsigned int    largest_newton_iterations = 40;
    unsigned int    largest_loop_iterations   = 150;
    double          damping                   = 2e-3; // of weaving, over E r
    unsigned int    line_search_from          = 5;
    double          growth                    = 1.3;
    unsigned int    largest_cuts              = 8;
    Preconditioning linear_solver             = Preconditioning::automatic;
    bool            benchmark                 = false;
    bool            error_estimate            = true;
  };

  /** What is written, and how often. */
  struct OutputParameters
  {
    unsigned int fields_every =
      1; // accepted increments; 0: only at the end of a stage
    Slices       slices = Slices::both;
    unsigned int slices_every =
      0; // accepted increments; 0: only at the start and end of a stage
    unsigned int section_points   = 12;
    unsigned int checkpoint_every = 1; // accepted increments
    bool         pictures         = true;
    bool         neighbors        = false;
    bool         iterations       = false;
    bool         only_summary     = false;

    std::vector<Export> exports;
    double voxel_size = 0; // [mm], 0: the smallest fiber radius, or more
  };

  /**
   * Everything a run depends on. Filled by parse(), completed by resolve(),
   * judged by check().
   */
  struct Parameters
  {
    // Some 300 GiB; a slip of the finger is refused before memory is asked for.
    static constexpr unsigned int most_nodes = 2000000;

    std::string              output_directory = "output";
    std::vector<std::string> stages           = {"weave", "relax", "biaxial"};
    Accuracy                 accuracy;
    double                   maximal_wall_time = 0; // [s], 0: unlimited

    // "fibers" when section Fibers has a source, "fabric" otherwise
    FabricParameters             fabric;
    FibersParameters             fibers;
    std::vector<std::string>     drive_names;
    std::vector<DriveParameters> drives;
    ContactParameters            contact;
    AllStageSettings             stage_settings;
    SolverParameters             solver;
    OutputParameters             output;

    // Notes on what was read: for the user, but no reason to refuse it.
    std::vector<std::string> notes;

    bool
    has_stage(const std::string &name) const;

    bool
    has_matrix() const
    {
      return stage_settings.describe_matrix();
    }

    /**
     * Whether a fabric is woven roughly, by coarse fibers that are not in
     * balance at the end.
     */
    bool
    is_preview() const
    {
      return accuracy.is_preview();
    }

    /** Whether the fibers are those of a fabric, not of section Fibers. */
    bool
    is_fabric() const
    {
      return fibers.sources().empty();
    }

    /**
     * Reads @p file and then the @p overrides ("Section/Entry=value"),
     * resolves and checks. Throws InputError with one line that names file,
     * line, entry and what is allowed.
     */
    static Parameters
    parse(const std::string &file, const std::vector<std::string> &overrides);

    /** Gives every automatic value but the fabric's layers its number. */
    void
    resolve();

    /**
     * Checks what is wrong only in combination. Throws InputError. The order
     * of the stages depends on where the run starts, see
     * check_stage_order().
     */
    void
    check() const;

    /**
     * Throws InputError when the stages from number @p next on make no sense
     * after @p stages_done , those that the restart file has behind it (none
     * without one).
     */
    void
    check_stage_order(const std::vector<std::string> &stages_done,
                      const unsigned int              next) const;

    /**
     * Where the value of the entry @p path ("Fabric/Warp/Tows") was given,
     * and its name, to begin an InputError with: "x.prm, line 3: Stages".
     */
    std::string
    where(const std::string &path) const;

    /** Writes every parameter with value, text and unit as a valid file. */
    void
    print(std::ostream &out) const;

    /** All parameters as tables in markdown, for doc/parameters.md. */
    static void
    print_reference(std::ostream &out);

  private:
    std::string                        source;    // the file
    std::map<std::string, std::string> locations; // of the entries set

    void
    resolve_preview();

    void
    declare(ParameterCatalogue &catalogue);

    void
    override_entries(const std::vector<std::string> &overrides,
                     ParameterCatalogue             &catalogue);

    void
    copy_warp_to_fill(ParameterCatalogue &catalogue) const;
  };

  /** Throws InputError, with the place @p where , if @p nodes are more than
   * Parameters::most_nodes , before anything of this size is built. */
  void
  check_number_of_nodes(const double nodes, const std::string &where);
} // namespace fiberloom

#endif
