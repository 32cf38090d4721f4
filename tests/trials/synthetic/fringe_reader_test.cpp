#include "synthetic/fringe_reader.hpp"
#include "test.hpp"

namespace zlg::trials::fringe_reader_test {

// Rotation of an eighth of a fringe, nearly, and a bias of 150.3 fringes a half, to and fro.
double phase_after(int half) { return 0.1237 * half + (half % 2 == 0 ? 150.3 : 0.0); }

struct Track {
    double worst_counts = 0.0;  // of counts and place together against the phase
    double rms_counts = 0.0;
    int known = 0;
    int first_known = -1;
};

Track track(const PhotodiodeLaw& law, int halves) {
    chance::Draw draw{7, chance::Cause::test};
    FringeReader reader{law, 0.0};
    if (law.learnt) reader.learn(draw);
    Track t;
    double counts = 0.0;
    for (int k = 1; k <= halves; ++k) {
        const FringeReading r = reader.read(phase_after(k), k % 2 == 0 ? 1 : -1, true, draw);
        counts += static_cast<double>(r.counts);
        if (!(r.fringe >= 0.0f)) continue;
        if (t.known++ == 0) t.first_known = k;
        const double off = counts + static_cast<double>(r.fringe) / core::count_parts - phase_after(k);
        EXPECT_DOUBLE_EQ(reader.reading_counts(), counts + static_cast<double>(r.fringe) / core::count_parts);
        t.worst_counts = std::fmax(t.worst_counts, std::abs(off));
        t.rms_counts += off * off;
    }
    if (t.known > 0) t.rms_counts = std::sqrt(t.rms_counts / t.known);
    return t;
}

TEST(FringeReader, WithoutPhotodiodesItCountsWholeFringes) {
    chance::Draw draw{1, chance::Cause::test};
    FringeReader reader{{}, 0.7};
    EXPECT_EQ(reader.read(3.2, 1, true, draw).counts, 3);
    EXPECT_EQ(reader.read(-0.1, -1, true, draw).counts, -4);
    EXPECT_DOUBLE_EQ(reader.reading_counts(), -1.0);
    EXPECT_TRUE(std::isnan(reader.read(0.5, 1, true, draw).fringe));
}

// White noise n of both photodiodes of amplitude 1 is n/(2 pi) turns; the larger sine and the angle change it by a
// tenth.
TEST(FringeReader, APlaceThatIsLearntHasTheNoiseOfThePhotodiodesAndNeverMissesACount) {
    const PhotodiodeLaw law{.reads = true, .learnt = true};
    const Track t = track(law, 20000);
    const double noise = law.noise / (2.0 * std::numbers::pi);
    EXPECT_GT(t.known, 19900);
    EXPECT_NEAR(t.rms_counts, noise, 0.15 * noise);
    EXPECT_LT(t.worst_counts, 10.0 * noise);
    EXPECT_LE(t.first_known, 2);
}

TEST(FringeReader, AtTheStartOfAGyroItsEllipseIsNotKnown) {
    const Track t = track({.reads = true}, 2000);
    EXPECT_GE(t.first_known, 128);
    EXPECT_LT(t.first_known, 400);
    EXPECT_LT(t.worst_counts, 0.05);
}

TEST(FringeReader, AHalfWithoutABeatHasNoPlace) {
    chance::Draw draw{3, chance::Cause::test};
    FringeReader reader{{.reads = true, .learnt = true}, 0.0};
    reader.learn(draw);
    reader.lose(5.9, draw);
    EXPECT_DOUBLE_EQ(reader.reading_counts(), 5.5);
    // Its counter goes on from there.
    const FringeReading r = reader.read(7.25, 1, false, draw);
    EXPECT_EQ(r.counts, 2);
    EXPECT_NEAR(static_cast<double>(r.fringe) / core::count_parts, 0.25, 0.02);
}

}  // namespace zlg::trials::fringe_reader_test
