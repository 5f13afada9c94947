// `ashlar picture`: frames of a run as PNG files, made without a display.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/command_line.hpp"

namespace ashlar {

/// What is drawn besides the blocks and how: as the controls of the page say it.
struct PictureParts {
  std::string contacts =
      "auto";  ///< colours of contact points: state, type, or none for no points and no forces; auto:
               ///< state, none where there are more than most_few_points
  bool no_arrows = false;       ///< no forces
  std::string joints = "none";  ///< colours of joint faces: opening, slip, state, normal, shear
  bool force_chain = false;     ///< a bar a joint, also with many contacts
  bool thrust_line = false;
  std::string vectors = "none";  ///< displacement, velocity
  bool crosses = false;          ///< of principal stresses
  std::optional<std::string>
      section;  ///< "x,0.5": cut at x = 0.5 m, what is beyond is left out; "-x,0.5": what is before
  std::optional<std::string> range;  ///< "low,high" of colours, SI
  std::string hidden;                ///< names or numbers of blocks that are not drawn, a,b,c
  bool si = false;                   ///< SI units, else mm, kN, MPa
  bool dark = false;
};

struct PictureOptions {
  std::filesystem::path folder;      ///< result folder
  std::optional<std::size_t> frame;  ///< index, 0 the first; empty: the last
  std::string size = "1200x800";     ///< pixels, WIDTHxHEIGHT, 16 to 8192 each
  std::string from =
      "0.55,-1,0.45";  ///< x,y,z: direction from the blocks to the eye, z is up; or the name of a view
  std::optional<std::string> at;  ///< x,y,z: point looked at, m; empty: the middle of all blocks
  double zoom = 1.0;              ///< > 0; 1 shows all blocks
  double scale = 1.0;             ///< > 0; of displacements
  std::string color = "displacement";
  std::optional<std::string> relative_to;  ///< as ViewOptions::relative_to
  bool frame_range = false;                ///< colours over the values of this frame, else of the whole run
  PictureParts parts;
  double time_limit = 120.0;  ///< s, > 0: after that a browser that makes no picture is ended
  std::optional<std::string>
      frames;  ///< "a:b", indices: all of these, NAME_0007.png and so on; not with frame
  std::filesystem::path picture;
};

/// A frame as a PNG.
struct DrawnFrame {
  std::size_t index;
  std::string png;
};

/// Declares the options that say how frames are drawn.
void declare_look(CLI::App& command, PictureOptions& options);
/// What is wrong with them; empty: nothing.
[[nodiscard]] std::string fault_of_look(const PictureOptions& options);

/// Draws frames in one browser. A page that would be too large holds every second, fourth ... of a run's frames: those
/// that it has are drawn.
/// @param frames "a:b"; empty: all. @throws std::invalid_argument for a folder or frames that are not there;
/// std::runtime_error without a browser, or as loaded_page
[[nodiscard]] std::vector<DrawnFrame> draw_frames(const PictureOptions& options,
                                                  const std::optional<std::string>& frames);

/// The picture is what `ashlar view` shows.
/// @return exit status; bad_input if an option or the folder is wrong, failed if there is no browser.
/// @throws std::runtime_error as loaded_page
[[nodiscard]] int picture_command(const PictureOptions& options, std::ostream& out, std::ostream& err);

void declare_picture_command(CLI::App& program, CommandContext& context);

}  // namespace ashlar
