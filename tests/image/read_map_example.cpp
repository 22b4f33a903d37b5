#include <fathom/image/map_files.h>

#include <cmath>
#include <iostream>

int main(int, char** arguments) {
  const fathom::DepthMap map = fathom::read_map(arguments[1]);
  const auto& Z = *map.values<float>("Z");
  for (std::size_t k = 0; k < Z.size(); ++k)
    if (std::isfinite(Z[k]))
      std::cout << k % map.width << ' ' << k / map.width << ' ' << Z[k] << '\n';
}
