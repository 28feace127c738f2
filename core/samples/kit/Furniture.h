// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Mesh.h"
#include "core/samples/kit/Random.h"

namespace reflet::kit {

/// Street furniture as templates: foot at the origin, front towards +x.
[[nodiscard]] Mesh lampPost();    ///< five globes on a cast-iron candelabra, 5.2 m
[[nodiscard]] Mesh streetLamp();  ///< one lantern, 4.4 m
[[nodiscard]] Mesh lightMast();   ///< a slender mast with a glowing head, 9 m
[[nodiscard]] Mesh bench();
[[nodiscard]] Mesh bollard();
[[nodiscard]] Mesh planter();  ///< square tub for an orange tree, 0.7 m high
[[nodiscard]] Mesh parasol(Paint cloth);
[[nodiscard]] Mesh cafeTable(Random& random);  ///< a table and its chairs
[[nodiscard]] Mesh kiosk();                    ///< octagonal newspaper kiosk
[[nodiscard]] Mesh tramShelter();              ///< glass and steel, 6 m along x, open towards -y
[[nodiscard]] Mesh litterBin();
[[nodiscard]] Mesh parkedCar(Paint body);                         ///< a small car, 3.9 m along x
[[nodiscard]] Mesh passerBy(Paint coat, Paint legs, Paint hair);  ///< somebody who stands, 1.75 m

}  // namespace reflet::kit
