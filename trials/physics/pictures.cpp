#include <zlg/trials/physics_pictures.hpp>

#include "parts.hpp"

namespace zlg::trials {

PhysicsPictures physics_pictures() {
    PhysicsPictures made;
    made.pictures.push_back(chain_picture());
    add_waves(made);
    add_bias(made);
    add_discriminator(made);
    add_field(made);
    add_lock_in(made);
    add_switch(made);
    add_piezo(made);
    add_misses(made);
    return made;
}

}  // namespace zlg::trials
