#include "apps/results/frames/vtu/pvd_writer.hpp"

#include <fmt/format.h>

#include <utility>

#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/xml_text.hpp"

namespace ashlar {

PvdWriter::PvdWriter(std::filesystem::path path, std::vector<PvdFrame> frames)
    : path_(std::move(path)), frames_(std::move(frames)) {
  write();
}

void PvdWriter::add_frame(double time, std::string file) {
  frames_.push_back({time, std::move(file)});
  try {
    write();
  } catch (...) {
    frames_.pop_back();
    throw;
  }
}

void PvdWriter::write() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const PvdFrame& frame : frames_) {
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time,
                        escape_xml(frame.file));
  }
  text += "  </Collection>\n</VTKFile>\n";
  write_file_atomically(path_, text, Durability::process);
}

}  // namespace ashlar
