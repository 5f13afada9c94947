#include "apps/program/view/svg_picture.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

#include "apps/program/view/headless_browser.hpp"
#include "apps/results/folder/scratch_folder.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/scene/meshes/base64.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

/// A page that stores the picture as the text of its element `picture`. The event `load` is sent when the image is
/// available.
std::string page_of(const std::string& svg, int width, int height) {
  return fmt::format(R"(<!DOCTYPE html>
<img id="svg" src="data:image/svg+xml;base64,{}" width="{}" height="{}">
<script>
window.onload = () => {{
  const image = document.getElementById("svg");
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [image.width, image.height];
  canvas.getContext("2d").drawImage(image, 0, 0, image.width, image.height);
  const text = document.createElement("pre");
  text.id = "picture";
  text.textContent = canvas.toDataURL("image/png").split(",")[1];
  document.documentElement.replaceChildren(text);
}};
</script>
)",
                     to_base64(svg), width, height);
}

}  // namespace

std::string png_of_svg(const std::filesystem::path& browser, const std::string& svg, int width, int height) {
  constexpr std::chrono::seconds limit(60);
  const ScratchFolder scratch;
  const std::filesystem::path page = scratch.path() / "picture.html";
  write_file_atomically(page, page_of(svg, width, height), Durability::process);
  const auto picture = left_text(loaded_page(browser, scratch.path(), page, "", limit), "picture");
  if (!picture) throw std::runtime_error(browser.string() + " made no picture");
  return from_base64(*picture);
}

std::string write_png(const std::string& svg, const std::filesystem::path& picture, int width, int height) {
  const auto browser = find_browser();
  if (!browser) return "no PNG beside it: there is no chromium in PATH, and ASHLAR_BROWSER is not set";
  try {
    write_file_atomically(picture, png_of_svg(*browser, svg, width, height), Durability::process);
    return "picture: " + picture.string();
  } catch (const std::exception& error) {
    return fmt::format("no PNG beside it: {}", fault_text(error));
  }
}

}  // namespace ashlar
