#pragma once
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>
