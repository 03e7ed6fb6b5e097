#pragma once
#include "clench/high/tall.h"
