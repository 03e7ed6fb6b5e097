// Includes second.h, which includes this one: a circle of two.
#pragma once
#include "clench/low/second.h"
