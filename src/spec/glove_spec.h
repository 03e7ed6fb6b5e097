// Data gloves: conversion of raw sensor values to DOF values of a hand.
#pragma once
#include <Eigen/Core>

namespace clench {

/// dofs = intercepts + slopes * raw
struct GloveCalibration {
  Eigen::MatrixXd slopes;      ///< DOFs x sensors [rad per count]
  Eigen::VectorXd intercepts;  ///< one per DOF [rad]
};

}  // namespace clench
