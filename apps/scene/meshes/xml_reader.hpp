// Streaming reader of untrusted XML: elements with their attributes, parsed by expat.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

/// Largest nesting of elements.
inline constexpr std::size_t most_xml_levels = 100;
/// Largest size of one tag, comment or instruction, bytes. expat rescans incomplete ones, hence a limit.
inline constexpr std::size_t longest_xml_token = 1U << 20U;

/// Names and values of a start tag, unprocessed; prefixes are part of names.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char** list) : list_(list) {}

  [[nodiscard]] std::optional<std::string_view> find(std::string_view name) const;
  /// Calls `use` with each name and value.
  void each(const std::function<void(std::string_view, std::string_view)>& use) const;

 private:
  const char** list_;
};

/// Receives elements; the place of the tag is added to a MeshFileError that it throws.
class XmlHandler {
 public:
  virtual ~XmlHandler() = default;
  virtual void start(std::string_view name, const XmlAttributes& attributes) = 0;
  virtual void end() = 0;
};

using XmlSink = std::function<void(std::string_view piece)>;

/// Reads a whole document. @param source passes its pieces to the sink, one after the other
/// @throws MeshFileError: not well-formed, a document type (which may declare entities), nesting too deep, a tag that is
/// too long; exceptions of the handler and of the source
void read_xml(XmlHandler& handler, const std::function<void(const XmlSink&)>& source);

/// Version of expat.
[[nodiscard]] std::string xml_library_version();

}  // namespace ashlar
