// The pictures and the numbers of docs/physics.md.
//
// usage: zlg_physics_pictures OUT_DIR

#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include <zlg/logs/table_file.hpp>
#include <zlg/trials/physics_pictures.hpp>

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
    zlg::logs::TableFile file{path.string(), true};
    file.append(text);
    file.close();
}

void write_all(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const zlg::trials::PhysicsPictures made = zlg::trials::physics_pictures();
    for (const zlg::trials::Picture& picture : made.pictures) {
        write(folder / (picture.name + ".svg"), zlg::trials::svg_file(picture));
    }
    write(folder / "numbers.md", zlg::trials::markdown(made.readings));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: zlg_physics_pictures OUT_DIR\n";
        return 2;
    }
    try {
        write_all(argv[1]);
    } catch (const std::exception& error) {
        std::cerr << "zlg_physics_pictures: " << argv[1] << ": " << error.what() << "\n";
        return 3;
    }
    return 0;
}
