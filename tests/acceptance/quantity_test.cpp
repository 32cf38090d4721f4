#include <zlg/acceptance/quantity.hpp>

#include "test.hpp"

namespace zlg::quantity_test {

using namespace acceptance;

TEST(Quantity, each_has_a_name_of_its_own_and_says_what_it_needs) {
    std::set<std::string_view> names;
    for (const QuantityInfo& q : quantities()) {
        EXPECT_TRUE(names.insert(q.name).second) << q.name;
        EXPECT_EQ(find_quantity(q.name), &q);
        EXPECT_FALSE(q.needs.empty() || q.words.empty() || q.kinds.empty()) << q.name;
    }
    EXPECT_EQ(find_quantity("bias"), nullptr);
    const auto of = [](bool (*has)(std::string_view)) {
        return std::ranges::count_if(quantities(), [has](const QuantityInfo& q) { return has(q.name); });
    };
    EXPECT_EQ(std::ssize(quantities()) - of(is_magnitude), 9) << "names of those with a sign";
}

TEST(Quantity, a_wrong_name_and_a_wrong_unit_are_told_apart) {
    EXPECT_EQ(unknown_quantity("bias.deg_s"), "'bias.deg_s': bias is given in deg/h; allowed is bias.deg_h");
    EXPECT_EQ(unknown_quantity("biass.deg_h"), "'biass.deg_h' is no quantity; did you mean bias.deg_h?");
}

}  // namespace zlg::quantity_test
