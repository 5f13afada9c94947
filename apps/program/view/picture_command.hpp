// `ashlar picture`: frames of a run as PNG files, made without a display.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"

namespace ashlar {

/// Drawn items besides the blocks, and their appearance: as in the controls of the page.
struct PictureParts {
  std::string contacts =
      "auto";  ///< colours of contact points: state, type, or none for no points and no forces; auto: state,
               ///< none if there are many
  bool no_arrows = false;       ///< no forces
  std::string joints = "none";  ///< colours of joint faces: opening, slip, state, normal, shear, water
  bool force_chain = false;     ///< a bar a joint, also with many contacts
  bool thrust_line = false;
  std::string vectors = "none";      ///< displacement, velocity
  std::vector<std::string> without;  ///< some of loads, supports, bolts, water, marks
  bool crosses = false;              ///< of principal stresses
  std::optional<std::string>
      section;  ///< "x,0.5": section at x = 0.5 m, the part beyond is hidden; "-x,0.5": the part before
  std::optional<std::string> range;  ///< "low,high" of colours, SI
  std::string hidden;                ///< names or numbers of blocks that are not drawn, a,b,c
  bool si = false;                   ///< SI units, otherwise mm, kN, MPa
  bool dark = false;
};

struct PictureOptions {
  std::filesystem::path folder;      ///< result folder
  std::optional<std::size_t> frame;  ///< index, 0 the first; empty: the last
  std::string size = "1200x800";     ///< pixels, WIDTHxHEIGHT, 16 to 8192 each
  int sharpness = 1;                 ///< 1 to 4: times as many pixels each way, letters and lines likewise
  std::string from =
      "0.55,-1,0.45";  ///< x,y,z: direction from the blocks to the eye, z is up; or the name of a view
  std::optional<std::string> at;  ///< x,y,z: point of view, m; empty: the centre of all blocks
  double zoom = 1.0;              ///< > 0; 1 shows all blocks
  double scale = 1.0;             ///< > 0; of displacements
  std::string color = "displacement";
  std::optional<std::string> relative_to;  ///< as ViewOptions::relative_to
  bool frame_range = false;                ///< colours over the values of this frame, otherwise of the whole
                                           ///< run
  PictureParts parts;
  double time_limit = 120.0;  ///< s, > 0: a browser without result is ended after that
  std::optional<std::string>
      frames;  ///< "a:b", indices: all of these, NAME_0007.png and so on; excludes frame
  std::filesystem::path picture;
};

/// A frame as a PNG.
struct DrawnFrame {
  std::size_t index;
  std::string png;
};

/// Declares the options for drawing frames.
void declare_look(CLI::App& command, PictureOptions& options);
/// Fault of these options; empty if valid.
[[nodiscard]] std::string fault_of_look(const PictureOptions& options);

/// Draws frames in one browser. If the page would be too large it holds every second, fourth ... frame of a run: only
/// those are drawn.
/// @param frames "a:b"; empty: all. @throws std::invalid_argument for a missing folder or frames;
/// std::runtime_error without a browser, or as loaded_page
[[nodiscard]] std::vector<DrawnFrame> draw_frames(const PictureOptions& options,
                                                  const std::optional<std::string>& frames);

/// Writes a picture of the page of `ashlar view`.
/// @return exit status; bad_input if an option or the folder is wrong, failed if there is no browser.
/// @throws std::runtime_error as loaded_page
[[nodiscard]] int picture_command(const PictureOptions& options, std::ostream& out, std::ostream& err);

void declare_picture_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar
