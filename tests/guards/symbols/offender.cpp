// What no object of the library may hold: the check must find each.

extern "C" void* malloc(__SIZE_TYPE__ byte_count);
extern "C" double sin(double angle);

namespace offender {

double angle = 1.0;
double late = sin(angle);

void* allocate() { return malloc(sizeof late); }

}  // namespace offender
