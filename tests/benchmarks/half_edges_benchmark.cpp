// The table of half-edges against CGAL::Surface_mesh: built from triangles and queried for the twin of every
// half-edge, or only queried; and the search for the contacts of two convex blocks, in which two such tables are
// made. The argument is the number of triangles: a box, then spheres. Items per second are triangles per
// second, of the search pairs per second.
#include <benchmark/benchmark.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <random>

#include "geometry/contacts/convex_search.hpp"
#include "geometry/solid/half_edges.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/placed_bodies.hpp"

namespace ashlar {
namespace {

using SurfaceMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

/// A box of 12 triangles, or a sphere of 20 4^k.
TriangleMesh mesh_of(long triangle_count) {
  if (triangle_count == 12) return make_box({0, 0, 0}, {1, 1, 1});
  int k = 0;
  while (20L << (2 * k) < triangle_count) ++k;
  return make_sphere({0, 0, 0}, 1.0, k);
}

void fill(const TriangleMesh& mesh, SurfaceMesh& surface) {
  using Vertex = SurfaceMesh::Vertex_index;
  for (const Vector3& p : mesh.points) surface.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto vertex = [](int i) { return Vertex(static_cast<SurfaceMesh::size_type>(i)); };
    surface.add_face(vertex(a), vertex(b), vertex(c));
  }
}

std::size_t sum_of_twins(const SurfaceMesh& surface) {
  std::size_t sum = 0;
  for (const auto f : surface.faces()) {
    auto h = surface.halfedge(f);
    for (int k = 0; k < 3; ++k, h = surface.next(h)) sum += surface.face(surface.opposite(h));
  }
  return sum;
}

/// By lists, as for hulls with changing triangles.
std::size_t sum_of_found(const TriangleMesh& mesh, const HalfEdges& half_edges) {
  std::size_t sum = 0;
  for (int h = 0; h < static_cast<int>(3 * mesh.triangles.size()); ++h)
    sum += static_cast<std::size_t>(half_edges.find(half_edges.end(h), half_edges.start(h)) / 3);
  return sum;
}

std::size_t sum_of_twins(const std::vector<int>& twins) {
  std::size_t sum = 0;
  for (const int twin : twins) sum += static_cast<std::size_t>(twin / 3);
  return sum;
}

template <class Work>
void run(benchmark::State& state, const TriangleMesh& mesh, Work work) {
  for ([[maybe_unused]] auto unused : state) benchmark::DoNotOptimize(work());
  state.SetItemsProcessed(state.iterations() * static_cast<long>(mesh.triangles.size()));
}

void made_and_asked_lists(benchmark::State& state) {
  const TriangleMesh mesh = mesh_of(state.range(0));
  run(state, mesh, [&] {
    HalfEdges half_edges(mesh.triangles, mesh.points.size());
    half_edges.add_all();
    return sum_of_found(mesh, half_edges);
  });
}

void made_and_asked_twins(benchmark::State& state) {
  const TriangleMesh mesh = mesh_of(state.range(0));
  run(state, mesh, [&] {
    HalfEdges half_edges(mesh.triangles, mesh.points.size());
    half_edges.add_all();
    return sum_of_twins(half_edges.twins());
  });
}

void made_and_asked_surface_mesh(benchmark::State& state) {
  const TriangleMesh mesh = mesh_of(state.range(0));
  run(state, mesh, [&] {
    SurfaceMesh surface;
    fill(mesh, surface);
    return sum_of_twins(surface);
  });
}

/// Its memory is kept from mesh to mesh.
void made_and_asked_surface_mesh_kept(benchmark::State& state) {
  const TriangleMesh mesh = mesh_of(state.range(0));
  SurfaceMesh surface;
  run(state, mesh, [&] {
    surface.clear_without_removing_property_maps();
    fill(mesh, surface);
    return sum_of_twins(surface);
  });
}

void asked_twins(benchmark::State& state) {
  const TriangleMesh mesh = mesh_of(state.range(0));
  HalfEdges half_edges(mesh.triangles, mesh.points.size());
  half_edges.add_all();
  const std::vector<int> twins = half_edges.twins();
  run(state, mesh, [&] { return sum_of_twins(twins); });
}

void asked_surface_mesh(benchmark::State& state) {
  const TriangleMesh mesh = mesh_of(state.range(0));
  SurfaceMesh surface;
  fill(mesh, surface);
  run(state, mesh, [&] { return sum_of_twins(surface); });
}

/// A body that stands with its lowest point a little in the other's top, turned at random: one table for the
/// hull of each.
void contact_search(benchmark::State& state) {
  const test_support::PlacedBody floor(test_support::box({-3, -3, -1}, {3, 3, 0}));
  TriangleMesh mesh = mesh_of(state.range(0));
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const Eigen::Quaterniond turn = Eigen::Quaterniond(uniform(), uniform(), uniform(), uniform()).normalized();
  double lowest = 0.0;
  for (Vector3& p : mesh.points) {
    p = turn * p;
    lowest = std::min(lowest, p.z());
  }
  for (Vector3& p : mesh.points) p.z() -= lowest + 1e-3;
  const test_support::PlacedBody body(Polyhedron(std::move(mesh), 1e-14));
  const ContactLimits limits{0.02, 0.02, std::numbers::pi / 18.0};
  for ([[maybe_unused]] auto unused : state) {
    PairContacts contacts = find_contacts(body.placed, floor.placed, limits);
    const ConvexSurface a(body.placed), b(floor.placed);
    benchmark::DoNotOptimize(settle_convex_contacts(a, b, {std::nullopt, 0.0, 1e-3}, contacts));
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(made_and_asked_lists)->Arg(12)->Arg(80)->Arg(320)->Arg(5120);
BENCHMARK(made_and_asked_twins)->Arg(12)->Arg(80)->Arg(320)->Arg(5120);
BENCHMARK(made_and_asked_surface_mesh)->Arg(12)->Arg(80)->Arg(320)->Arg(5120);
BENCHMARK(made_and_asked_surface_mesh_kept)->Arg(12)->Arg(80)->Arg(320)->Arg(5120);
BENCHMARK(asked_twins)->Arg(12)->Arg(80)->Arg(320)->Arg(5120);
BENCHMARK(asked_surface_mesh)->Arg(12)->Arg(80)->Arg(320)->Arg(5120);
BENCHMARK(contact_search)->Arg(12)->Arg(80)->Arg(320);

}  // namespace
}  // namespace ashlar
