#pragma once
#include "clench/high/cellar/stairs.h"
