#include "apps/scene/meshes/xml_reader.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>

namespace ashlar {
namespace {

/// Pieces of one document on their way to expat.
class XmlReader {
 public:
  explicit XmlReader(XmlHandler& to);
  ~XmlReader() { XML_ParserFree(parser_); }
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;

  void take(std::string_view piece);
  void finish() { check(XML_Parse(parser_, "", 0, XML_TRUE) == XML_STATUS_OK); }

 private:
  void check(bool good);

  [[nodiscard]] MeshFileError error(const std::string& what) const {
    const auto number = [](XML_Size value) { return static_cast<int>(std::min<XML_Size>(value, 1U << 30U)); };
    return {what, number(XML_GetCurrentLineNumber(parser_)), number(XML_GetCurrentColumnNumber(parser_)) + 1};
  }

  /// Exceptions must not pass through expat.
  template <class Action>
  void guarded(Action action) {
    if (failure_) return;
    try {
      action();
    } catch (const MeshFileError& fault) {
      failure_ = std::make_exception_ptr(error(fault.what()));
    } catch (...) {
      failure_ = std::current_exception();
    }
    if (failure_) XML_StopParser(parser_, XML_FALSE);
  }

  XML_Parser parser_;
  XmlHandler& handler_;
  std::size_t levels_ = 0;
  std::size_t consumed_ = 0;
  std::exception_ptr failure_;
};

XmlReader& reader_of(void* data) {
  return *static_cast<XmlReader*>(data);
}

XmlReader::XmlReader(XmlHandler& to) : parser_(XML_ParserCreate(nullptr)), handler_(to) {
  if (parser_ == nullptr) throw std::bad_alloc();
  XML_SetUserData(parser_, this);
  XML_SetStartElementHandler(parser_, [](void* data, const char* name, const char** attributes) {
    XmlReader& reader = reader_of(data);
    reader.guarded([&] {
      if (++reader.levels_ > most_xml_levels)
        throw MeshFileError(
            fmt::format("elements are nested more than {} deep, which is what is allowed", most_xml_levels),
            0, 0);
      reader.handler_.start(name, XmlAttributes(attributes));
    });
  });
  XML_SetEndElementHandler(parser_, [](void* data, const char*) {
    XmlReader& reader = reader_of(data);
    reader.guarded([&] {
      --reader.levels_;
      reader.handler_.end();
    });
  });
  XML_SetStartDoctypeDeclHandler(parser_, [](void* data, const char*, const char*, const char*, int) {
    reader_of(data).guarded(
        [] { throw MeshFileError("document type declaration, allowed are files without one", 0, 0); });
  });
}

void XmlReader::check(bool good) {
  if (failure_) std::rethrow_exception(failure_);
  if (good) return;
  const XML_Error code = XML_GetErrorCode(parser_);
  if (code == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
  throw error(fmt::format("no well-formed XML ({})", XML_ErrorString(code)));
}

void XmlReader::take(std::string_view piece) {
  constexpr std::size_t most = 1U << 18U;  // at once; expat counts in int
  for (; !piece.empty(); piece.remove_prefix(std::min(piece.size(), most))) {
    const std::string_view part = piece.substr(0, most);
    check(XML_Parse(parser_, part.data(), static_cast<int>(part.size()), XML_FALSE) == XML_STATUS_OK);
    consumed_ += part.size();
    const XML_Index parsed = std::max<XML_Index>(XML_GetCurrentByteIndex(parser_), 0);
    if (consumed_ - static_cast<std::size_t>(parsed) > longest_xml_token + most)
      throw error(
          fmt::format("tag or comment of more than {} bytes, which is what is allowed", longest_xml_token));
  }
}

}  // namespace

std::optional<std::string_view> XmlAttributes::find(std::string_view name) const {
  for (const char** entry = list_; *entry != nullptr; entry += 2)
    if (*entry == name) return entry[1];
  return std::nullopt;
}

void XmlAttributes::each(const std::function<void(std::string_view, std::string_view)>& use) const {
  for (const char** entry = list_; *entry != nullptr; entry += 2) use(entry[0], entry[1]);
}

void read_xml(XmlHandler& handler, const std::function<void(const XmlSink&)>& source) {
  XmlReader reader(handler);
  source([&reader](std::string_view piece) { reader.take(piece); });
  reader.finish();
}

std::string xml_library_version() {
  const XML_Expat_Version version = XML_ExpatVersionInfo();
  return fmt::format("{}.{}.{}", version.major, version.minor, version.micro);
}

}  // namespace ashlar
