#include <Inventor/SoDB.h>
static SoSeparator* node;
