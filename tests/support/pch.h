#pragma once
#include <doctest/doctest.h>

#if __has_include(<Eigen/Geometry>)  // base knows no Eigen
#include <Eigen/Geometry>
#endif
#include <string>
#include <vector>
