#include "tests/manifolds/run_detent.h"
#include "tests/support/test.h"
