#include "mechanics/block/rigid_motions.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace ashlar {
namespace {

/// A motion is admissible if its projection on the admissible space differs by less than this.
constexpr double projection_tolerance = 1e-5;

/// Reduced row echelon form from the last columns on, so that rotations appear in as few rows as can be.
void reduce_rows(Eigen::MatrixXd& rows) {
  Eigen::Index done = 0;
  for (Eigen::Index column = rows.cols() - 1; column >= 0 && done < rows.rows(); --column) {
    const Eigen::Index last = rows.rows() - 1 - done;
    Eigen::Index pivot = 0;
    const double largest = rows.col(column).head(last + 1).cwiseAbs().maxCoeff(&pivot);
    if (largest < projection_tolerance) continue;
    rows.row(pivot).swap(rows.row(last));
    rows.row(last) /= rows(last, column);
    for (Eigen::Index row = 0; row < rows.rows(); ++row) {
      if (row != last) rows.row(row) -= rows(row, column) * rows.row(last);
    }
    ++done;
  }
  rows = (rows.cwiseAbs().array() < projection_tolerance).select(0.0, rows);
}

std::string text(const Vector3& v, double scale) {
  std::ostringstream stream;
  stream << std::setprecision(4) << '[';
  for (Eigen::Index k = 0; k < 3; ++k)
    stream << (k > 0 ? ", " : "") << (std::abs(v[k]) < projection_tolerance * scale ? 0.0 : v[k]);
  stream << ']';
  return stream.str();
}

}  // namespace

std::vector<RigidMotion> admissible_rigid_motions(const BlockModel& block) {
  if (block.fixed() || block.space().held()) return {};
  const Eigen::Index p = block.basis().size();
  const Eigen::MatrixXd all = block.basis().rigid_motions(block.size());
  Eigen::MatrixXd outside(3 * p, 6);
  for (int mode = 0; mode < 6; ++mode) {
    const Eigen::MatrixX3d motion = all.col(mode).reshaped(p, 3);
    outside.col(mode) = (motion - block.space().expand(block.space().restrict(motion))).reshaped() /
                        std::sqrt(block.basis().volume());
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(outside, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const auto kept = (svd.singularValues().array() > projection_tolerance).count();
  Eigen::MatrixXd rows = svd.matrixV().rightCols(6 - kept).transpose();
  reduce_rows(rows);
  std::vector<RigidMotion> motions;
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    motions.push_back({rows.row(k).head<3>().transpose(), rows.row(k).tail<3>().transpose()});
  }
  return motions;
}

std::string describe(const std::vector<RigidMotion>& motions, const BlockModel& block) {
  if (motions.size() == 6) return "any rigid motion";
  std::string result;
  for (const RigidMotion& motion : motions) {
    if (!result.empty()) result += ", ";
    const double turn = motion.rotation.norm();
    if (turn == 0.0) {
      result += "translation along " + text(motion.translation.normalized(), 1.0);
      continue;
    }
    const Vector3 through =
        block.basis().centroid() + motion.rotation.cross(motion.translation) * block.size() / (turn * turn);
    result +=
        "rotation about " + text(motion.rotation / turn, 1.0) + " through " + text(through, block.size());
  }
  return result;
}

}  // namespace ashlar
