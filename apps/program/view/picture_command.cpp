#include "apps/program/view/picture_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "apps/program/number_option.hpp"
#include "apps/program/view/headless_browser.hpp"
#include "apps/program/view/view_command.hpp"
#include "apps/program/view/view_file.hpp"
#include "apps/results/folder/scratch_folder.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/scene/meshes/base64.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

std::string check_size(const std::string& text) {
  const std::vector<int> size = numbers_of<int>(text, 'x');
  const auto fits = [](int pixels) { return pixels >= 16 && pixels <= 8192; };
  if (size.size() == 2 && fits(size[0]) && fits(size[1])) return "";
  return fmt::format("malformed size ({}); give WIDTHxHEIGHT with 16 to 8192 pixels each", text);
}

bool is_vector(const std::vector<double>& numbers) {
  return numbers.size() == 3 &&
         std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

constexpr std::array view_names = {"front", "back", "left",
                                   "right", "top",  "iso"};  // those of page/camera.js

std::string check_direction(const std::string& text) {
  if (std::find(view_names.begin(), view_names.end(), text) != view_names.end()) return "";
  const std::vector<double> direction = numbers_of<double>(text, ',');
  const bool good = is_vector(direction) && direction != std::vector(3, 0.0);
  return good ? ""
              : fmt::format("malformed direction ({}); give x,y,z, not all zero, or {}", text,
                            fmt::join(view_names, ", "));
}

std::string check_point(const std::optional<std::string>& text) {
  if (!text || is_vector(numbers_of<double>(*text, ','))) return "";
  return fmt::format("malformed point ({}); give x,y,z", *text);
}

/// "x,0.5" or "-x,0.5"
std::string check_section(const std::optional<std::string>& text) {
  if (!text) return "";
  const std::size_t comma = text->find(',');
  const std::string axis =
      text->substr(text->starts_with('-') ? 1 : 0, comma - (text->starts_with('-') ? 1 : 0));
  const bool good = comma != std::string::npos && (axis == "x" || axis == "y" || axis == "z");
  const std::vector<double> place =
      good ? numbers_of<double>(std::string_view(*text).substr(comma + 1), ',') : std::vector<double>{};
  if (place.size() == 1 && std::isfinite(place.front())) return "";
  return fmt::format("malformed section ({}); give an axis and a place such as x,0.5 or -x,0.5", *text);
}

/// Names become part of an address.
std::string check_hidden(const std::string& names) {
  const bool plain = std::all_of(names.begin(), names.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == ',' || c == '.' || c == '-' || c == '_';
  });
  return plain ? ""
               : fmt::format(
                     "malformed names of blocks ({}); give names of letters, digits, . - and _, or numbers",
                     names);
}

std::string check_range(const PictureOptions& options) {
  const std::optional<std::string>& text = options.parts.range;
  if (!text) return "";
  const std::vector<double> range = numbers_of<double>(*text, ',');
  if (range.size() != 2 || !std::isfinite(range[0]) || !std::isfinite(range[1]) || !(range[0] < range[1]))
    return fmt::format("malformed range ({}); give LOW,HIGH in SI units with LOW < HIGH", *text);
  return "";
}

std::string check_positive(std::string_view name, double value) {
  return value > 0.0 && std::isfinite(value)
             ? ""
             : fmt::format("{} is not positive ({}); give more than 0", name, value);
}

/// Fragment of the page's address, read by page/address.js. @param frames "frame=3" or "frames=0:7"
std::string wishes(const PictureOptions& options, const std::string& frames) {
  const PictureParts& parts = options.parts;
  std::string text =
      fmt::format("picture&{}&size={}&from={}&color={}&zoom={}&scale={}&theme={}", frames, options.size,
                  options.from, options.color, options.zoom, options.scale, parts.dark ? "dark" : "light");
  if (options.sharpness != 1) text += fmt::format("&sharpness={}", options.sharpness);
  if (parts.contacts != "auto") text += "&contacts=" + parts.contacts;
  if (parts.no_arrows) text += "&arrows=none";
  if (parts.force_chain) text += "&chain=yes";
  if (parts.thrust_line) text += "&thrust=yes";
  if (parts.crosses) text += "&crosses=yes";
  for (const std::string& part : parts.without) text += "&" + part + "=no";
  if (parts.si) text += "&units=si";
  text += fmt::format("&joints={}&vectors={}", parts.joints, parts.vectors);
  if (parts.section) text += "&section=" + *parts.section;
  if (!parts.hidden.empty()) text += "&hide=" + parts.hidden;
  if (options.at) text += "&at=" + *options.at;
  if (options.frame_range) text += "&range=frame";
  if (parts.range) {
    const std::size_t comma = parts.range->find(',');
    text += fmt::format("&range=own&low={}&high={}", parts.range->substr(0, comma),
                        parts.range->substr(comma + 1));
  }
  return text;
}

/// Requested points are in the page regardless of their number.
ViewPoints points_of(const PictureOptions& options) {
  const std::string& contacts = options.parts.contacts;
  return contacts == "state" || contacts == "type" ? ViewPoints::all : ViewPoints::few;
}

int make_picture(const PictureOptions& options, const std::filesystem::path& browser, std::ostream& out,
                 std::ostream& err) {
  const ScratchFolder scratch;
  const std::filesystem::path view = scratch.path() / "view.html";
  const auto complain = [&](const std::string& what, int status) {
    err << "ashlar: error: " << what << '\n';
    return status;
  };
  ViewReport report;
  try {
    refuse_other_file(options.picture, png_picture());
    ViewOptions wanted;
    wanted.frame = options.frame;
    wanted.points = points_of(options);
    wanted.relative_to = options.relative_to;
    report = write_view_file(options.folder, view, wanted);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return complain(fault_text(error), exit_status::of(error));
  }
  const std::size_t frame = options.frame.value_or(report.frames - 1);
  const std::string page =
      loaded_page(browser, scratch.path(), view, wishes(options, fmt::format("frame={}", frame)),
                  std::chrono::duration<double>(options.time_limit));
  if (const auto fault = left_text(page, "fault")) return complain(*fault, exit_status::bad_input);
  const auto picture = left_text(page, "picture");
  if (!picture) return complain(browser.string() + " made no picture", exit_status::failed);
  write_file_of_kind(options.picture, from_base64(*picture), png_picture());
  out << fmt::format("picture: {} (frame {} of 0 to {})\n", options.picture.string(), frame,
                     report.frames - 1);
  return exit_status::done;
}

/// NAME.png, 7 -> NAME_0007.png
std::filesystem::path numbered(const std::filesystem::path& picture, std::size_t index) {
  std::filesystem::path name = picture.parent_path() / picture.stem();
  name += fmt::format("_{:04}.png", index);
  return name;
}

int make_pictures(const PictureOptions& options, std::ostream& out, std::ostream& err) {
  try {
    for (const DrawnFrame& frame : draw_frames(options, options.frames)) {
      const std::filesystem::path picture = numbered(options.picture, frame.index);
      write_file_of_kind(picture, frame.png, png_picture());
      out << fmt::format("picture: {}\n", picture.string());
    }
  } catch (const std::invalid_argument& error) {
    err << "ashlar: error: " << error.what() << '\n';
    return exit_status::bad_input;
  }
  return exit_status::done;
}

}  // namespace

std::string fault_of_look(const PictureOptions& options) {
  for (const std::string& fault :
       {check_size(options.size), check_direction(options.from), check_point(options.at),
        check_positive("zoom", options.zoom), check_positive("scale", options.scale),
        check_positive("time limit", options.time_limit), check_section(options.parts.section),
        check_range(options), check_hidden(options.parts.hidden)})
    if (!fault.empty()) return fault;
  return "";
}

std::vector<DrawnFrame> draw_frames(const PictureOptions& options, const std::optional<std::string>& frames) {
  const auto browser = find_browser();
  if (!browser)
    throw std::runtime_error("no chromium in PATH, which draws the frames; install it or set ASHLAR_BROWSER");
  const ScratchFolder scratch;
  const std::filesystem::path view = scratch.path() / "view.html";
  ViewReport report;
  try {
    ViewOptions wanted;
    wanted.points = points_of(options);
    wanted.relative_to = options.relative_to;
    report = write_view_file(options.folder, view, wanted);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (exit_status::of(error) == exit_status::failed) throw;
    throw std::invalid_argument(fault_text(error));
  }
  const std::size_t last = report.frames - 1;
  std::vector<std::size_t> range = {0, last};
  if (frames) range = numbers_of<std::size_t>(*frames, ':');
  if (range.size() != 2 || range[0] > range[1] || range[1] > last)
    throw std::invalid_argument(
        fmt::format("malformed frames ({}); give A:B with 0 <= A <= B <= {}", frames.value_or(""), last));
  const std::string page = loaded_page(*browser, scratch.path(), view,
                                       wishes(options, fmt::format("frames={}:{}", range[0], range[1])),
                                       std::chrono::duration<double>(options.time_limit));
  if (const auto fault = left_text(page, "fault")) throw std::invalid_argument(*fault);
  const auto pictures = left_text(page, "pictures");
  if (!pictures || pictures->empty()) throw std::runtime_error(browser->string() + " made no pictures");
  std::vector<DrawnFrame> drawn;
  std::istringstream lines(*pictures);
  std::string picture;
  for (std::size_t index = 0; lines >> index >> picture;) drawn.push_back({index, from_base64(picture)});
  return drawn;
}

int picture_command(const PictureOptions& options, std::ostream& out, std::ostream& err) {
  if (const std::string fault = fault_of_look(options); !fault.empty()) {
    err << "ashlar: error: " << fault << '\n';
    return exit_status::bad_input;
  }
  if (options.picture.empty()) {
    err << "ashlar: error: the picture has no name (\"\"); give a name\n";
    return exit_status::bad_input;
  }
  if (const std::string suffix = CLI::detail::to_lower(options.picture.extension().string());
      !suffix.empty() && suffix != ".png") {
    err << fmt::format("ashlar: error: pictures are PNG files ({}); give a name that ends with .png\n",
                       options.picture.string());
    return exit_status::bad_input;
  }
  const auto browser = find_browser();
  if (!browser) {
    err << "ashlar: error: no chromium in PATH, which draws the picture; install it or set ASHLAR_BROWSER\n";
    return exit_status::failed;
  }
  return options.frames ? make_pictures(options, out, err) : make_picture(options, *browser, out, err);
}

namespace {

void declare_parts(CLI::App& command, PictureParts& parts) {
  command
      .add_option("--contacts", parts.contacts,
                  "Points by state, type or none (default: state, up to 60 of them)")
      ->type_name("WORD")
      ->check(CLI::IsMember({"auto", "state", "type", "none"}));
  command.add_flag("--no-arrows", parts.no_arrows,
                   "Contacts without their forces, as where there are more than 500");
  command
      .add_option("--joints", parts.joints,
                  "Joint faces by opening, slip, state, normal or shear (stress), water (pressure) or "
                  "fracture (energy)")
      ->type_name("WORD")
      ->check(CLI::IsMember({"none", "opening", "slip", "state", "normal", "shear", "water", "fracture"}));
  command.add_flag("--force-chain", parts.force_chain, "A bar for the force in each joint");
  command.add_flag("--thrust-line", parts.thrust_line, "The line through the forces in the joints");
  command.add_option("--vectors", parts.vectors, "Arrows of displacement or velocity")
      ->type_name("WORD")
      ->check(CLI::IsMember({"none", "displacement", "velocity"}));
  command
      .add_option("--without", parts.without,
                  "Items that are not drawn: loads, supports, bolts, water, marks")
      ->type_name("WORD,...")
      ->delimiter(',')
      ->check(CLI::IsMember({"loads", "supports", "bolts", "water", "marks"}));
  command.add_flag("--crosses", parts.crosses, "Crosses of principal stresses");
  command.add_option("--section", parts.section, "Cut at x = 0.5: x,0.5; keeping the other side: -x,0.5")
      ->type_name("AXIS,M");
  command.add_option("--hide", parts.hidden, "Blocks that are not drawn, by name or number")
      ->type_name("A,B,...");
  command.add_option("--range", parts.range, "Colours from LOW to HIGH, SI units")->type_name("LOW,HIGH");
  command.add_flag("--si", parts.si, "SI units (default: mm, kN, MPa)");
  command.add_flag("--dark", parts.dark, "On a dark ground");
}

}  // namespace

void declare_look(CLI::App& command, PictureOptions& options) {
  const CLI::Validator any_number = real_number_option({});  // fault_of_look() knows the ranges
  command.add_option("--size", options.size, "Pixels (default: " + options.size + ")")->type_name("WxH");
  command
      .add_option("--sharpness", options.sharpness,
                  "Pixels of the picture for each of --size, for sharp screens and print (default: 1)")
      ->type_name("N")
      ->transform(whole_number_option(1, 4));
  command
      .add_option("--from", options.from,
                  "Direction to the eye, or front, right, top, iso ... (default: " + options.from + ")")
      ->type_name("X,Y,Z");
  command.add_option("--color", options.color, "Colour by (default: displacement)")
      ->type_name("FIELD")
      ->check(CLI::IsMember({"displacement", "displacement_x", "displacement_y", "displacement_z", "velocity",
                             "von_mises", "pressure", "sigma_1", "sigma_3", "stress_xx", "stress_yy",
                             "stress_zz", "stress_xy", "stress_yz", "stress_xz", "block", "order", "stone"}));
  declare_relative_to(command, options.relative_to);
  command.add_flag("--frame-range", options.frame_range,
                   "Colours over the values of this frame (default: of the whole run)");
  command.add_option("--at", options.at, "Centre of the view (default: the centre of all blocks)")
      ->type_name("X,Y,Z");
  command.add_option("--zoom", options.zoom, "Magnification over the whole view (default: 1)")
      ->type_name("F")
      ->transform(any_number);
  command.add_option("--scale", options.scale, "Displacements times (default: 1)")
      ->type_name("F")
      ->transform(any_number);
  declare_parts(command, options.parts);
  command
      .add_option("--time-limit", options.time_limit,
                  fmt::format("Seconds for the browser (default: {:g})", options.time_limit))
      ->type_name("S")
      ->transform(any_number);
}

void declare_picture_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("picture", "Draw frames of a run as PNG, without a display");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<PictureOptions>();
  command->add_option("DIR", options->folder, "Result folder of a run")->required()->type_name("");
  command->add_option("--frame", options->frame, "Index of the frame, 0 the first (default: the last)")
      ->type_name("N")
      ->transform(whole_number_option(0));
  command->add_option("--frames", options->frames, "Frames A to B, as NAME_0007.png and so on")
      ->type_name("A:B")
      ->excludes("--frame");
  declare_look(*command, *options);
  command->add_option("-o,--out", options->picture, "PNG to write")->required()->type_name("FILE");
  command->callback(
      [options, &context] { context.status = picture_command(*options, context.out, context.err); });
}

}  // namespace ashlar
