#pragma once
// Whether the reader has closed all that it opened in the HDF5 library.

#include <hdf5.h>

#include "claim.hpp"

// The library itself loses some memory when it gives up on a damaged file. What the reader forgets to close is claimed
// below; what it allocates itself is not in the library.
extern "C" __attribute__((used)) inline const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }

namespace zlg::fuzz {

inline hsize_t n_objects(H5I_type_t kind) {
    hsize_t n = 0;
    // Of a kind that was never used there is no count.
    if (H5Itype_exists(kind) > 0) H5Inmembers(kind, &n);
    return n;
}

inline void claim_nothing_is_open() {
    for (const H5I_type_t kind : {H5I_FILE, H5I_GROUP, H5I_DATASET, H5I_ATTR, H5I_DATASPACE}) {
        claim(n_objects(kind) == 0, "every object of a file is closed");
    }
    static const hsize_t predefined_lists = n_objects(H5I_GENPROP_LST);
    static const hsize_t predefined_types = n_objects(H5I_DATATYPE);
    claim(n_objects(H5I_GENPROP_LST) == predefined_lists, "every list of properties is closed");
    claim(n_objects(H5I_DATATYPE) == predefined_types, "every type is closed");
}

}  // namespace zlg::fuzz
