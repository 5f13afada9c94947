#include "apps/program/view/view_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "apps/program/view/joint_resultants.hpp"
#include "apps/program/view/pack_marks.hpp"
#include "apps/program/view/packed_numbers.hpp"
#include "apps/results/frames/grid_arrays.hpp"
#include "apps/results/tables/history_table.hpp"
#include "apps/scene/model/model_position.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "geometry/boxes/box.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

ViewSurface surface_of(const UnstructuredGrid& grid) {
  ViewSurface surface;
  surface.reference = grid.points;
  if (const auto* values = find_values<double>(grid.point_data, "displacement", 3)) {
    for (std::size_t i = 0; i < grid.points.size(); ++i)
      surface.reference[i] -= Vector3((*values)[3 * i], (*values)[3 * i + 1], (*values)[3 * i + 2]);
  }
  surface.block_of_point.assign(grid.points.size(), -1);
  const auto& block = required_values<std::int32_t>(grid.cell_data, "block", 1);
  const auto& order = required_values<std::int32_t>(grid.cell_data, "order", 1);
  const auto& face = required_values<std::int32_t>(grid.cell_data, "face", 1);
  int start = 0;
  for (std::size_t c = 0; c < grid.offsets.size(); ++c) {
    const int end = grid.offsets[c];
    surface.cells.insert(surface.cells.end(), {block[c], order[c], face[c], end - start});
    for (int k = start; k < end; ++k) {
      const int point = grid.connectivity[at(k)];
      surface.cells.push_back(point);
      surface.block_of_point[at(point)] = block[c];
    }
    start = end;
  }
  constexpr std::int32_t most_blocks = 65536;  // numbers of blocks are packed as 16 bits
  if (!block.empty() && *std::max_element(block.begin(), block.end()) >= most_blocks)
    throw std::runtime_error(fmt::format("more than {} blocks, which no page shows", most_blocks));
  surface.velocity = find_values<double>(grid.point_data, "velocity", 3) != nullptr;
  surface.stress = find_values<double>(grid.point_data, "stress", 6) != nullptr;
  return surface;
}

/// Numbers of fixed blocks; empty: the frame is from a version without array "fixed".
std::optional<std::vector<std::int32_t>> fixed_blocks_in(const UnstructuredGrid& grid) {
  const auto* fixed = find_values<std::int32_t>(grid.cell_data, "fixed", 1);
  if (fixed == nullptr) return std::nullopt;
  const auto& block = required_values<std::int32_t>(grid.cell_data, "block", 1);
  std::set<std::int32_t> numbers;
  for (std::size_t c = 0; c < block.size(); ++c)
    if ((*fixed)[c] != 0) numbers.insert(block[c]);
  return std::vector(numbers.begin(), numbers.end());
}

/// Places of the points of each block of order 0.
std::map<std::int32_t, std::vector<Vector3>> places_of_order_zero(const UnstructuredGrid& grid) {
  const auto& block = required_values<std::int32_t>(grid.cell_data, "block", 1);
  const auto& order = required_values<std::int32_t>(grid.cell_data, "order", 1);
  std::map<std::int32_t, std::vector<Vector3>> places;
  int start = 0;
  for (std::size_t c = 0; c < grid.offsets.size(); ++c) {
    const int end = grid.offsets[c];
    for (int k = start; order[c] == 0 && k < end; ++k)
      places[block[c]].push_back(grid.points[at(grid.connectivity[at(k)])]);
    start = end;
  }
  return places;
}

void pack_blocks(PackedNumbers& numbers, const UnstructuredGrid& grid, const ViewSurface& surface) {
  if (grid.points.size() != surface.reference.size())
    throw std::runtime_error("the frames have different numbers of points");
  std::vector<Vector3> displacements = grid.points;
  for (std::size_t i = 0; i < displacements.size(); ++i) displacements[i] -= surface.reference[i];
  numbers.add_displacements(displacements, surface.block_of_point);
  if (surface.velocity) numbers.add_reals(required_values<double>(grid.point_data, "velocity", 3), 3);
  if (surface.stress) numbers.add_reals(required_values<double>(grid.point_data, "stress", 6), 6);
}

void pack_joints(PackedNumbers& numbers, const UnstructuredGrid& grid, const ViewSurface& surface,
                 Json& head) {
  const auto& data = grid.cell_data;
  std::vector<std::int32_t> corners;
  for (std::size_t c = 0; c < grid.offsets.size(); ++c)
    corners.push_back(grid.offsets[c] - (c == 0 ? 0 : grid.offsets[c - 1]));
  std::vector<std::int32_t> state = required_values<std::int32_t>(data, "state", 1);
  const auto& broken = required_values<std::int32_t>(data, "broken", 1);
  head["joints"] = corners.size();
  head["corners"] = grid.connectivity.size();
  if (corners.empty()) return;
  for (std::size_t c = 0; c < state.size(); ++c) state[c] += broken[c] != 0 ? 3 : 0;
  const auto& slip = required_values<double>(data, "slip", 3);
  std::vector<double> lengths;
  for (std::size_t c = 0; c < slip.size(); c += 3)
    lengths.push_back(std::hypot(slip[c], slip[c + 1], slip[c + 2]));
  numbers.add_integers(corners);
  numbers.add_integers(state);
  for (const char* name : {"block_a", "block_b"})
    numbers.add_integers(required_values<std::int32_t>(data, name, 1));
  numbers.add_reals(required_values<double>(data, "opening", 1), 1);
  numbers.add_reals(lengths, 1);
  for (const char* name : {"normal_traction", "shear_traction", "area"})
    numbers.add_reals(required_values<double>(data, name, 1), 1);
  if (surface.water) numbers.add_reals(required_values<double>(data, "water_pressure", 1), 1);
  if (surface.fracture) numbers.add_reals(required_values<double>(data, "fracture_energy", 1), 1);
  std::vector<Vector3> places;
  for (const int point : grid.connectivity) places.push_back(grid.points[at(point)]);
  numbers.add_points(places);
}

void pack_links(PackedNumbers& numbers, const UnstructuredGrid& contacts, Json& head) {
  const std::vector<FrameResultant> resultants = joint_resultants(contacts);
  std::vector<std::int32_t> a, b, state;
  std::vector<double> forces;
  std::vector<Vector3> places;
  for (const FrameResultant& joint : resultants) {
    a.push_back(joint.a);
    b.push_back(joint.b);
    state.push_back(joint.state);
    forces.insert(forces.end(), {joint.force.x(), joint.force.y(), joint.force.z()});
    places.push_back(joint.place);
  }
  head["links"] = resultants.size();
  if (resultants.empty()) return;
  for (const auto* values : {&a, &b, &state}) numbers.add_integers(*values);
  numbers.add_reals(forces, 3);
  numbers.add_points(places);
}

void pack_points(PackedNumbers& numbers, const UnstructuredGrid& contacts) {
  const auto& data = contacts.point_data;
  const auto& force = required_values<double>(data, "force", 3);
  const auto& normal = required_values<double>(data, "normal", 3);
  const auto& gap = required_values<double>(data, "gap", 1);
  const auto& area = required_values<double>(data, "area", 1);
  if (contacts.points.empty()) return;
  for (const char* name : {"type", "state", "block_a", "block_b"})
    numbers.add_integers(required_values<std::int32_t>(data, name, 1));
  for (const auto* values : {&force, &normal}) numbers.add_reals(*values, 3);
  for (const auto* values : {&gap, &area}) numbers.add_reals(*values, 1);
  numbers.add_points(contacts.points);
}

void move_to_origin(UnstructuredGrid& grid, const Vector3& origin) {
  if (origin.isZero(0.0)) return;
  for (Vector3& point : grid.points) point -= origin;
}

/// The folder, if it has results.
const std::filesystem::path& checked_folder(const std::filesystem::path& folder) {
  constexpr const char* needed =
      "the folder that `ashlar run SCENE` wrote is needed (SCENE.out, or that of --out)";
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(fmt::format("no result folder ({} {}), {}", folder.string(),
                                         std::filesystem::exists(folder) ? "is a file" : "does not exist",
                                         needed));
  }
  if (!has_stored_frames(folder))
    throw std::runtime_error(fmt::format(
        "no results in {} (neither blocks.pvd nor results.vtkhdf exists), {}", folder.string(), needed));
  return folder;
}

/// True if blocks may be added or removed.
bool has_stages(const std::filesystem::path& folder) {
  const std::vector<std::string> columns = read_history(folder / "history.csv", 1).columns;
  return std::find(columns.begin(), columns.end(), "stage") != columns.end();
}

}  // namespace

ViewFrames::ViewFrames(const std::filesystem::path& folder, ViewPoints points)
    : points_(points), stored_(open_stored_frames(checked_folder(folder))) {
  // Frames of a run with output.solid have volumes, and separate surfaces of blocks.
  if (stored_->has("surfaces")) blocks_ = "surfaces";
  // A run in progress has written some of them first.
  count_ = std::min(stored_->count(blocks_), stored_->count("contacts"));
  for (const char* series : {"joints", "bolts", "loads"})
    if (written(series)) count_ = std::min(count_, stored_->count(series));
  if (count_ == 0) throw std::runtime_error(fmt::format("{} has no frames", folder.string()));
  const std::filesystem::path path = stored_->file(blocks_, 0);
  UnstructuredGrid first = stored_->read(blocks_, 0);
  origin_ = origin_for(box_of(first.points));
  move_to_origin(first, origin_);
  block_names_ = first.block_names;
  std::optional<std::vector<std::int32_t>> fixed;
  // A cracked block has the name of its first part.
  const std::vector<std::string> last_names = stored_->read(blocks_, count_ - 1).block_names;
  if (!block_names_.empty() && last_names != block_names_) page_blocks_.emplace(last_names);
  if (page_blocks_ || has_stages(folder)) first = all_blocks();
  naming_the_file(path, [&] {
    fixed = fixed_blocks_in(first);
    curved_ = std::make_unique<CurvedCells>(first);
    surface_ = surface_of(curved_->divided(std::move(first)));
  });
  if (written("joints")) {
    const UnstructuredGrid joints = grid_of("joints", 0);
    surface_.water = find_values<double>(joints.cell_data, "water_pressure", 1) != nullptr;
    surface_.fracture = find_values<double>(joints.cell_data, "fracture_energy", 1) != nullptr;
  }
  surface_.fixed = fixed ? *std::move(fixed) : blocks_that_never_move();
}

UnstructuredGrid ViewFrames::all_blocks() {
  for (std::size_t k = 0; k < count_; ++k)
    naming_the_file(stored_->file(blocks_, k), [&] {
      if (page_blocks_) page_blocks_->add(stored_->read(blocks_, k).block_names);
      all_blocks_.add(grid_of(blocks_, k));
    });
  if (page_blocks_) block_names_ = page_blocks_->names();
  return all_blocks_.whole();
}

UnstructuredGrid ViewFrames::grid_of(const std::string& series, std::size_t frame) const {
  UnstructuredGrid grid = stored_->read(series, frame);
  move_to_origin(grid, origin_);
  if (page_blocks_) page_blocks_->renumber(grid, frame);
  return grid;
}

bool ViewFrames::written(const std::string& series) const {
  return stored_->has(series) && stored_->count(series) > 0;
}

std::vector<std::int32_t> ViewFrames::blocks_that_never_move() const {
  std::map<std::int32_t, std::vector<Vector3>> first;
  std::set<std::int32_t> moved;
  for (std::size_t k = 0; k < count_; ++k) {
    const UnstructuredGrid grid = grid_of(blocks_, k);
    naming_the_file(stored_->file(blocks_, k), [&] {
      for (auto& [block, places] : places_of_order_zero(grid)) {
        const auto [known, is_new] = first.try_emplace(block, std::move(places));
        if (!is_new && known->second != places) moved.insert(block);
      }
    });
  }
  std::vector<std::int32_t> still;
  for (const auto& [block, places] : first)
    if (!moved.contains(block)) still.push_back(block);
  return still;
}

ViewFrameData ViewFrames::read(std::size_t index) const {
  PackedNumbers numbers;
  const FrameTime frame = stored_->time(blocks_, index);
  Json head = {{"index", index}, {"step", frame.step}, {"time", frame.time}};
  UnstructuredGrid blocks = grid_of(blocks_, index);
  naming_the_file(stored_->file(blocks_, index), [&] {
    pack_blocks(numbers, curved_->divided(all_blocks_.completed(std::move(blocks))), surface_);
  });
  head["joints"] = head["corners"] = 0;
  const auto pack = [&](const char* series, auto function) {
    if (!written(series)) return;
    const UnstructuredGrid grid = grid_of(series, index);
    naming_the_file(stored_->file(series, index), [&] { function(numbers, grid, head); });
  };
  pack("joints", [&](auto& to, const auto& grid, Json& of) { pack_joints(to, grid, surface_, of); });
  const std::filesystem::path of_contacts = stored_->file("contacts", index);
  const UnstructuredGrid contacts = grid_of("contacts", index);
  const bool kept = points_ == ViewPoints::all || contacts.points.size() <= most_few_points;
  naming_the_file(of_contacts, [&] { pack_links(numbers, contacts, head); });
  head["bolts"] = head["loads"] = head["supports"] = head["support_corners"] = 0;
  pack("bolts", pack_bolts);
  pack("loads", pack_loads_and_supports);
  naming_the_file(of_contacts, [&] {
    if (kept) pack_points(numbers, contacts);
  });
  head["points"] = kept ? contacts.points.size() : 0;
  head["contacts"] = contacts.points.size();
  return {std::move(head), numbers.base64()};
}

}  // namespace ashlar
