#include "apps/scene/meshes/threemf_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "apps/scene/meshes/threemf_model.hpp"
#include "apps/scene/meshes/zip_archive.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

/// The list of the root parts of a package.
class Relationships : public XmlHandler {
 public:
  void start(std::string_view name, const XmlAttributes& attributes) override {
    constexpr std::string_view model = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
    if (!name.ends_with("Relationship") || attributes.find("Type") != model) return;
    if (target_.empty()) target_ = attributes.find("Target").value_or("");
  }
  void end() override {}

  /// Name of the model part; empty: there is none.
  [[nodiscard]] std::string model_part() const {
    return target_.starts_with('/') ? target_.substr(1) : target_;
  }

 private:
  std::string target_;
};

/// Parses a part while it is inflated. @return its bytes
std::size_t read_part(const ZipArchive& archive, std::string_view name, std::size_t most,
                      XmlHandler& handler) {
  const ZipArchive::Entry* entry = archive.find(name);
  if (entry == nullptr)
    throw MeshFileError(fmt::format("no {} in the package, which is needed", printable(name)), 0, 0);
  std::size_t bytes = 0;
  try {
    read_xml(handler, [&](const XmlSink& take) {
      archive.read(*entry, most, [&](std::string_view piece) {
        bytes += piece.size();
        take(piece);
      });
    });
  } catch (const MeshFileError& error) {
    throw MeshFileError(fmt::format("{}: {}", printable(name), error.what()), error.line(), error.column());
  }
  return bytes;
}

}  // namespace

std::size_t most_inflated(std::size_t bytes) {
  constexpr std::size_t always = 16U << 20U;
  constexpr std::size_t ratio = 100;
  return std::max(always, ratio * bytes);
}

ShapeLayout read_3mf(std::string_view bytes) {
  const ZipArchive archive(bytes);
  Relationships relationships;
  constexpr std::size_t most_relationships = 1U << 20U;
  (void)read_part(archive, "_rels/.rels", most_relationships, relationships);
  if (relationships.model_part().empty())
    throw MeshFileError("package has no 3-D model, which 3MF files have", 0, 0);
  ThreemfModel model;
  const std::size_t size = read_part(archive, relationships.model_part(), most_inflated(bytes.size()), model);
  return std::move(model).layout(size);
}

ShapeLayout read_3mf_model(std::string_view xml) {
  ThreemfModel model;
  read_xml(model, [xml](const XmlSink& take) { take(xml); });
  return std::move(model).layout(xml.size());
}

}  // namespace ashlar
