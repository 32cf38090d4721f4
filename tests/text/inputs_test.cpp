#include <zlg/text/inputs.hpp>

#include "test.hpp"

namespace zlg::text::inputs_test {

namespace fs = std::filesystem;

// One test, for the list belongs to the process.
TEST(Inputs, AFileIsTheSameUnderAllItsNames) {
    const fs::path folder = fs::path{testing::TempDir()} / "zlg-inputs";
    fs::remove_all(folder);
    fs::create_directory(folder);
    std::ofstream{folder / "read"} << "a";
    std::ofstream{folder / "other"} << "a";
    fs::create_symlink(folder / "read", folder / "symbolic");
    fs::create_hard_link(folder / "read", folder / "hard");

    note_input(folder / "read");
    EXPECT_NO_THROW(refuse_input(folder / "read")) << "nobody asked for the list yet";
    watch_inputs();
    note_input(folder / "read");
    for (const char* name : {"read", "symbolic", "hard", "../zlg-inputs/read"})
        EXPECT_THROW(refuse_input(folder / name), OutputIsInput) << name;
    EXPECT_NO_THROW(refuse_input(folder / "other"));
    EXPECT_NO_THROW(refuse_input(folder / "not there"));
    note_input(folder / "not there");
    EXPECT_NO_THROW(refuse_input(folder / "other"));
    fs::remove_all(folder);
}

}  // namespace zlg::text::inputs_test
