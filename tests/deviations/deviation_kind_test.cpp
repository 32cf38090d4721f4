#include <zlg/deviations/deviation_kind.hpp>

#include <zlg/deviations/series.hpp>

#include "test.hpp"

using namespace zlg::deviations;

TEST(DeviationKind, is_known_by_its_name) {
    for (const auto kind : deviation_kinds) EXPECT_EQ(deviation_kind_of(name_of(kind)), kind);
    EXPECT_EQ(deviation_kinds.size(), 7u);
    EXPECT_EQ(name_of(DeviationKind::tdev), "tdev");
    EXPECT_THROW((void)deviation_kind_of("avar"), SeriesError);
}

TEST(DeviationKind, has_third_differences_where_a_drift_must_drop_out) {
    EXPECT_EQ(difference_order(DeviationKind::oadev), 2);
    EXPECT_EQ(difference_order(DeviationKind::totdev), 2);
    EXPECT_EQ(difference_order(DeviationKind::hdev), 3);
    EXPECT_EQ(difference_order(DeviationKind::ohdev), 3);
}

TEST(DeviationKind, of_the_averaged_angle_and_of_differences_side_by_side) {
    for (const auto kind : deviation_kinds) {
        EXPECT_EQ(is_modified(kind), name_of(kind)[0] == 'm' || kind == DeviationKind::tdev) << name_of(kind);
        EXPECT_EQ(is_side_by_side(kind), kind == DeviationKind::adev || kind == DeviationKind::hdev) << name_of(kind);
    }
}
