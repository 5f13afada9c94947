// One step of rigid blocks on elastic joints: the displacements under which the forces of all joints balance the loads.
//
// Bodies have displacements u from the start of the step, in the coordinates of a cone programme (cone_program.hpp), in
// which their mass matrix is the unit matrix. Points start with forces p0. With d = G u the displacement of the first
// body relative to the second one at a point, mu, c, T, M its strength, psi its dilation:
//
//   N' = N0 - kn dn                              t' = t0 - ks dt                               (elastic)
//   N  = N' within -T and M                      t  = t'              if |t'| <= c + mu N        (sticking)
//   N  = N' + kn tan(psi) s within -T and M      t  = (c + mu N) t'/|t'|,  |t'| - |t| = ks s     (sliding by s)
//   F + G'p(u) = m u                                                                           (balance)
//
// Sliding joints open by their dilation angle only, unlike associated flow. With m > 0 the step is one of a slow motion
// whose velocity is dropped at its end, m the mass over the square of the step; it has a solution for large m. Newton's
// method with the exact, unsymmetric tangent and a line search on the residual.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "solver/limit/cone_program.hpp"

namespace ashlar {

/// Constants of a point, in units of the model (RigidUnits) and m.
struct JointSpring {
  double normal = 0.0;    ///< kn, > 0 if the point transmits normal force
  double shear = 0.0;     ///< ks, likewise
  double dilation = 0.0;  ///< tan(psi), >= 0
};

/// State of a point at the end of a step.
enum class SpringState { open, sticks, slides };

struct SpringSolution {
  bool converged = false;
  std::vector<BodyVelocity> moved;     ///< u, by body
  std::vector<Eigen::Vector3d> force;  ///< p, by point
  std::vector<SpringState> states;     ///< by point
  int iterations = 0;
};

class SpringStep {
 public:
  /// @param program bodies, pairs and points; its strengths are read at each step. It must outlive this
  /// @param points by point of the programme
  SpringStep(const ConeProgram& program, std::vector<JointSpring> points);
  ~SpringStep();
  SpringStep(const SpringStep&) = delete;
  SpringStep& operator=(const SpringStep&) = delete;
  SpringStep(SpringStep&&) = delete;
  SpringStep& operator=(SpringStep&&) = delete;

  /// @param start forces p0. @param load F. @param inertia m, > 0
  [[nodiscard]] SpringSolution solve(const std::vector<Eigen::Vector3d>& start,
                                     const std::vector<BodyVelocity>& load, double inertia);

  /// Mean of the largest stiffness of each body by its joints: the scale of `inertia`.
  [[nodiscard]] double stiffness() const { return stiffness_; }

 private:
  struct Matrix;
  struct Response {
    Eigen::Vector3d force;
    Eigen::Matrix3d tangent;  ///< -dp/dd
    SpringState state;
  };

  [[nodiscard]] Response response(std::size_t k, const Eigen::Vector3d& start,
                                  const Eigen::Vector3d& d) const;
  /// Fills forces and states. @return F + G'p - m u
  [[nodiscard]] Eigen::VectorXd residual(const std::vector<Eigen::Vector3d>& start,
                                         const std::vector<BodyVelocity>& load, double inertia,
                                         SpringSolution& at, std::vector<Eigen::Matrix3d>& tangents) const;
  [[nodiscard]] bool factorize(const std::vector<Eigen::Matrix3d>& tangents, double inertia);

  const ConeProgram& program_;
  std::vector<JointSpring> points_;
  std::vector<int> offsets_;  ///< first unknown by body, and their number
  double stiffness_ = 0.0;
  std::unique_ptr<Matrix> matrix_;
};

}  // namespace ashlar
