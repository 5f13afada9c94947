// The library of scenes links and works without that of results. Use: scene SCENE
#include <ashlar/scene.hpp>

#include <iostream>

int main(int count, char** arguments) {
  if (count != 2) return 2;
  ashlar::Diagnostics faults;
  const auto loaded = ashlar::load_scene(arguments[1], {}, faults);
  faults.print(std::cerr);
  if (!loaded) return 2;
  const auto built = ashlar::build_simulation(*loaded, 1, faults);
  std::cout << built->simulation.blocks().size() << " blocks\n";
}
