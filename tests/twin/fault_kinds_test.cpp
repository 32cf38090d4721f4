#include <zlg/twin/fault_kinds.hpp>

#include "test.hpp"

namespace zlg::twin::fault_kinds_test {

TEST(FaultKinds, EachHasARowWithANameOfItsOwn) {
    EXPECT_EQ((std::set<std::string_view>{fault_kind_names.begin(), fault_kind_names.end()}.size()), n_fault_kinds);
    EXPECT_EQ((std::set<FaultKind>{all_fault_kinds.begin(), all_fault_kinds.end()}.size()), n_fault_kinds);
    for (const FaultKind kind : all_fault_kinds) EXPECT_EQ(facts(kind).kind, kind);
    EXPECT_EQ(facts(FaultKind::laser_off).name, "laser_off");
    EXPECT_EQ(facts(FaultKind::light_nan).name, "light_nan");
    EXPECT_EQ(facts(FaultKind::overspeed).name, "overspeed");
    EXPECT_EQ(n_fault_kinds, static_cast<std::size_t>(FaultKind::overspeed) + 1) << "the last of the enumeration";
}

TEST(FaultKinds, ARandomOneIsWithinWhatIsAllowed) {
    for (const FaultFacts& f : fault_table) {
        EXPECT_GE(f.either_sign ? -f.random_size.most : f.random_size.least, f.size.least) << f.name;
        EXPECT_LE(f.random_size.most, f.size.most) << f.name;
        EXPECT_LE(f.random_size.least, f.random_size.most) << f.name;
        EXPECT_TRUE(f.random_s.least > 0.0 && f.random_s.least <= f.random_s.most) << f.name;
    }
}

}  // namespace zlg::twin::fault_kinds_test
