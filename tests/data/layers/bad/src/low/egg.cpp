#include "clench/low/egg.h"
#include "clench/low/hen.h"
