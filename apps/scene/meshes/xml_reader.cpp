#include "apps/scene/meshes/xml_reader.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>

namespace ashlar {

struct XmlReader::State {
  explicit State(XmlHandler& to) : parser(XML_ParserCreate(nullptr)), handler(to) {
    if (parser == nullptr) throw std::bad_alloc();
  }
  ~State() { XML_ParserFree(parser); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  [[nodiscard]] MeshFileError error(const std::string& what) const {
    const auto number = [](XML_Size value) { return static_cast<int>(std::min<XML_Size>(value, 1U << 30U)); };
    return {what, number(XML_GetCurrentLineNumber(parser)), number(XML_GetCurrentColumnNumber(parser)) + 1};
  }

  /// Exceptions must not pass through expat.
  template <class Action>
  void guarded(Action action) {
    if (failure) return;
    try {
      action();
    } catch (const MeshFileError& fault) {
      failure = std::make_exception_ptr(error(fault.what()));
    } catch (...) {
      failure = std::current_exception();
    }
    if (failure) XML_StopParser(parser, XML_FALSE);
  }

  XML_Parser parser;
  XmlHandler& handler;
  std::size_t levels = 0;
  std::size_t taken = 0;
  std::exception_ptr failure;
};

namespace {

template <class State>
State& state_of(void* data) {
  return *static_cast<State*>(data);
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

XmlReader::XmlReader(XmlHandler& handler) : state_(std::make_unique<State>(handler)) {
  XML_SetUserData(state_->parser, state_.get());
  XML_SetStartElementHandler(state_->parser, [](void* data, const char* name, const char** attributes) {
    State& state = state_of<State>(data);
    state.guarded([&] {
      if (++state.levels > most_xml_levels)
        throw MeshFileError(
            fmt::format("elements are nested more than {} deep, which is what is allowed", most_xml_levels),
            0, 0);
      state.handler.start(name, XmlAttributes(attributes));
    });
  });
  XML_SetEndElementHandler(state_->parser, [](void* data, const char*) {
    State& state = state_of<State>(data);
    state.guarded([&] {
      --state.levels;
      state.handler.end();
    });
  });
  XML_SetStartDoctypeDeclHandler(state_->parser, [](void* data, const char*, const char*, const char*, int) {
    state_of<State>(data).guarded(
        [] { throw MeshFileError("document type declaration, allowed are files without one", 0, 0); });
  });
}

XmlReader::~XmlReader() = default;

void XmlReader::check(bool good) {
  if (state_->failure) std::rethrow_exception(state_->failure);
  if (good) return;
  const XML_Error code = XML_GetErrorCode(state_->parser);
  if (code == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
  throw state_->error(fmt::format("no well-formed XML ({})", XML_ErrorString(code)));
}

void XmlReader::take(std::string_view piece) {
  constexpr std::size_t most = 1U << 18U;  // at once; expat counts in int
  for (; !piece.empty(); piece.remove_prefix(std::min(piece.size(), most))) {
    const std::string_view part = piece.substr(0, most);
    check(XML_Parse(state_->parser, part.data(), static_cast<int>(part.size()), XML_FALSE) == XML_STATUS_OK);
    state_->taken += part.size();
    const XML_Index parsed = std::max<XML_Index>(XML_GetCurrentByteIndex(state_->parser), 0);
    if (state_->taken - static_cast<std::size_t>(parsed) > longest_xml_token + most)
      throw state_->error(
          fmt::format("tag or comment of more than {} bytes, which is what is allowed", longest_xml_token));
  }
}

void XmlReader::finish() {
  check(XML_Parse(state_->parser, "", 0, XML_TRUE) == XML_STATUS_OK);
}

std::string xml_library_version() {
  const XML_Expat_Version version = XML_ExpatVersionInfo();
  return fmt::format("{}.{}.{}", version.major, version.minor, version.micro);
}

}  // namespace ashlar
