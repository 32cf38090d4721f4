// The lists of fields.hpp have no code of their own. They are compiled here once, so that a member that was renamed is
// an error of this library and not only of the program and of Python, which use them.
#include <zlg/study/fields.hpp>
