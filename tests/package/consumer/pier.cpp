// A scene driven from C++: a pier under once and twice its load. Use: pier SCENE RESULT_FOLDER
#include <ashlar/run.hpp>

#include <cmath>
#include <exception>
#include <iostream>
#include <utility>

int main(int count, char** arguments) {
  if (count != 3) return 2;
  try {
    ashlar::Diagnostics faults;
    auto scene = ashlar::load_scene(arguments[1], {}, faults);
    faults.print(std::cerr);
    if (!scene) return 2;
    ashlar::Run run(std::move(*scene), 2);
    for (const double factor : {1.0, 2.0}) {
      run.set_load_factor("pier", 0, factor);
      while (run.step()) {
      }
      // The stress of a block of order 1 is that at its centre: -(load + 2000 kg/m^3 * 10 m/s^2 * 1 m).
      const ashlar::PointMotion middle = run.motion("pier", {0.5, 0.5, 1.0});
      std::cout << to_string(*run.status()) << ", vertical stress " << std::lround(middle.stress(2, 2) / 1e3)
                << " kPa\n";
    }
    run.write(arguments[2]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
