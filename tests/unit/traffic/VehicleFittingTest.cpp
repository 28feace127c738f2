// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/VehicleProposal.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

/// Adds a box as a part of its own, in the axes of glTF: x to the left, y up, z forward.
void addBox(GltfModel& model, const std::string& name, const glm::vec3& lo, const glm::vec3& hi,
            std::uint16_t material = 0) {
    GltfPart part;
    part.name = name;
    part.firstTriangle = model.triangles.size();
    part.bounds.add(glm::dvec3(lo));
    part.bounds.add(glm::dvec3(hi));
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            const auto base = std::uint32_t(model.positions.size());
            for (int k = 0; k < 4; ++k) {
                glm::vec3 p(0.0F);
                p[axis] = side == 1 ? hi[axis] : lo[axis];
                p[(axis + 1) % 3] = (k & 1) != 0 ? hi[(axis + 1) % 3] : lo[(axis + 1) % 3];
                p[(axis + 2) % 3] = (k & 2) != 0 ? hi[(axis + 2) % 3] : lo[(axis + 2) % 3];
                glm::vec3 n(0.0F);
                n[axis] = side == 1 ? 1.0F : -1.0F;
                model.positions.push_back(p);
                model.normals.push_back(n);
            }
            const std::uint32_t b = side == 1 ? 1 : 2;
            model.triangles.emplace_back(base, base + b, base + 3 - b);
            model.triangles.emplace_back(base + 3, base + 3 - b, base + b);
            model.triangleMaterial.insert(model.triangleMaterial.end(), 2, material);
        }
    }
    part.triangleCount = model.triangles.size() - part.firstTriangle;
    model.parts.push_back(part);
    model.bounds.add(part.bounds);
}

GltfMaterial material(const char* name) {
    GltfMaterial m;
    m.name = name;
    m.metallic = 0.0F;
    return m;
}

/// A bus of 12 m with its headlight at +Z and wheels below, all lengths times `unit`.
GltfModel bus(float unit) {
    GltfModel model;
    model.name = "city bus";
    model.materials = {material("body"), material("tyre"), material("glass")};
    addBox(model, "/hull", glm::vec3(-1.25F, 0.4F, -6) * unit, glm::vec3(1.25F, 3, 6) * unit, 0);
    addBox(model, "/wheel", glm::vec3(-1.2F, 0, 3) * unit, glm::vec3(1.2F, 0.9F, 4) * unit, 1);
    addBox(model, "/headlight", glm::vec3(-1, 0.6F, 5.9F) * unit, glm::vec3(1, 0.8F, 6) * unit, 2);
    return model;
}

TEST(VehicleProposal, TellsTheUnitOfAFileByTheLengthThatItGives) {
    for (const auto& [unit, metres] :
         {std::pair{1.0F, 1.0}, {100.0F, 0.01}, {1000.0F, 0.001}, {39.37F, 0.0254}}) {
        const VehicleProposal p = proposeFit(bus(unit));
        EXPECT_DOUBLE_EQ(p.model.scale, metres);
        EXPECT_NEAR(p.length, 12.0, 0.01);
        EXPECT_NEAR(p.height, 3.0, 0.01);
        EXPECT_EQ(p.kind, VehicleKind::Bus);
        EXPECT_FALSE(p.sizeReason.empty());
    }
    const VehicleProposal odd = proposeFit(bus(5.0F));
    EXPECT_GT(odd.length, 9.0);
    EXPECT_LT(odd.length, 15.0);
    EXPECT_FALSE(odd.concerns.empty());
}

TEST(VehicleProposal, TurnsItsNamedFrontForwardWhicheverWayTheFileLies) {
    for (const int quarter : {0, 1, 2, 3}) {
        GltfModel model = bus(1.0F);
        const auto turn = [&](glm::vec3 v) {
            for (int i = 0; i < quarter; ++i)
                v = {v.z, v.y, -v.x};
            return v;
        };
        for (glm::vec3& p : model.positions)
            p = turn(p);
        for (glm::vec3& n : model.normals)
            n = turn(n);
        model.bounds = {};
        for (GltfPart& part : model.parts) {
            const Box old = part.bounds;
            part.bounds = {};
            part.bounds.add(glm::dvec3(turn(glm::vec3(old.min))));
            part.bounds.add(glm::dvec3(turn(glm::vec3(old.max))));
            model.bounds.add(part.bounds);
        }
        const VehicleProposal p = proposeFit(model);
        EXPECT_TRUE(p.frontCertain);
        const Vehicle vehicle = makeVehicle(model, p.model);
        ASSERT_EQ(vehicle.bodies.size(), 2U);
        double light = 0.0;
        for (const VehicleBody& body : vehicle.bodies) {
            for (std::size_t i = 0; i < body.triangles.size(); ++i) {
                if (body.triangleMaterial[i] == 2)
                    light = body.offset + double(body.vertices[body.triangles[i].x].x);
            }
        }
        EXPECT_GT(light, 5.8) << quarter;
    }
}

TEST(VehicleProposal, SetsAVehicleOnItsWheelsThatComesUpsideDown) {
    GltfModel model = bus(1.0F);
    for (glm::vec3& p : model.positions)
        p = {-p.x, -p.y, p.z};
    for (glm::vec3& n : model.normals)
        n = {-n.x, -n.y, n.z};
    model.bounds = {};
    for (GltfPart& part : model.parts) {
        std::swap(part.bounds.min.y, part.bounds.max.y);
        part.bounds.min.y *= -1.0;
        part.bounds.max.y *= -1.0;
        model.bounds.add(part.bounds);
    }
    const VehicleProposal p = proposeFit(model);
    EXPECT_EQ(p.model.up, VehicleUp::MinusY);
    EXPECT_NE(p.upReason.find("turned over"), std::string::npos);
    const Vehicle vehicle = makeVehicle(model, p.model);
    float wheel = 0.0F;
    for (const VehicleBody& body : vehicle.bodies) {
        for (std::size_t i = 0; i < body.triangles.size(); ++i) {
            if (body.triangleMaterial[i] == 1)
                wheel = std::max(wheel, body.vertices[body.triangles[i].x].z);
        }
    }
    EXPECT_NEAR(wheel, 0.9F, 1e-3F);
}

TEST(VehicleProposal, OffersReflectionsToPaintThatHasNone) {
    const GltfModel model = bus(1.0F);
    const VehicleProposal p = proposeFit(model);
    EXPECT_LT(p.reflectingBefore, 0.01);
    EXPECT_GT(p.reflectingAfter, 0.8);
    EXPECT_TRUE(p.model.coat);
    const Vehicle coated = makeVehicle(model, p.model);
    EXPECT_EQ(coated.materials[0].clearCoat, 1.0F);
    EXPECT_EQ(coated.materials[1].clearCoat, 0.0F);
    EXPECT_EQ(coated.materials[2].glass, 1.0F);
    VehicleModel plain = p.model;
    plain.coat = false;
    const Vehicle asInFile = makeVehicle(model, plain);
    EXPECT_EQ(asInFile.materials[0].clearCoat, 0.0F);
    EXPECT_EQ(asInFile.materials[2].glass, 0.0F);
}

TEST(VehicleFitting, KeepsEveryUpAxisRightHanded) {
    for (const VehicleUp up : {VehicleUp::PlusY, VehicleUp::MinusY, VehicleUp::PlusZ,
                               VehicleUp::MinusZ, VehicleUp::PlusX, VehicleUp::MinusX}) {
        const glm::dmat3 m = uprightFromFile(up);
        EXPECT_DOUBLE_EQ(glm::dot(m[0], glm::cross(m[1], m[2])), 1.0);
    }
    EXPECT_EQ(uprightFromFile(VehicleUp::PlusY) * glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
    EXPECT_EQ(uprightFromFile(VehicleUp::MinusY) * glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1));
    EXPECT_EQ(uprightFromFile(VehicleUp::PlusZ) * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1));
    EXPECT_EQ(uprightFromFile(VehicleUp::MinusX) * glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
}

TEST(VehicleFitting, CutsALongVehicleIntoRigidBodiesWithoutLosingAnyOfIt) {
    const GltfModel model = bus(1.0F);
    const Vehicle vehicle = makeVehicle(model, proposeFit(model).model);
    ASSERT_EQ(vehicle.bodies.size(), 2U);
    EXPECT_NEAR(vehicle.length(), 12.0, 1e-4);
    double area = 0.0;
    for (const VehicleBody& body : vehicle.bodies) {
        for (const glm::uvec3& t : body.triangles) {
            const glm::vec3& a = body.vertices[t.x];
            area += 0.5 *
                    double(glm::length(glm::cross(body.vertices[t.y] - a, body.vertices[t.z] - a)));
        }
    }
    const double hull = 2 * (2.5 * 2.6 + 2.5 * 12 + 2.6 * 12);
    const double wheel = 2 * (2.4 * 0.9 + 2.4 * 1 + 0.9 * 1);
    const double light = 2 * (2 * 0.2 + 2 * 0.1 + 0.2 * 0.1);
    EXPECT_NEAR(area, hull + wheel + light, 1e-3);
    EXPECT_GT(vehicle.bodies[0].offset, vehicle.bodies[1].offset);
    EXPECT_DOUBLE_EQ(vehicle.bodies[0].offset + vehicle.bodies[0].pivotMiddle,
                     vehicle.bodies[1].offset + vehicle.bodies[1].pivotMiddle);
}

}  // namespace
}  // namespace reflet
