#pragma once
#include "clench/high/roof/tiles.h"
