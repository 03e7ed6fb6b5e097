#include "clench/low/egg.h"
