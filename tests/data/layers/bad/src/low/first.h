// Includes second.h, which includes this one: a cycle of two.
#pragma once
#include "clench/low/second.h"
