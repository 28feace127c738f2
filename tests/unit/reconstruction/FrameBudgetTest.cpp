// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/FrameBudget.h"
#include "core/reconstruction/LodSettings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace reflet {
namespace {

/// A street in which cars drive, and a machine that draws it: what pictures take by a law that
/// FrameBudget does not know, with noise.
class Street {
public:
    struct Machine {
        double rest = 12.0;     // ms of everything but reflections
        double perUnit = 3e-5;  // ms
        double eachMap = 0.15;  // ms
        double noise = 0.05;    // share
        double hiccup = 0.0;    // share of pictures that take 60 ms more
    };
    struct Car {
        BodyView view;
        double step = 0.3;  // metres from picture to picture
        double moved = 1e9;
        bool missing = true;
        std::optional<Detail> held;
    };

    explicit Street(double budget, unsigned seed = 1) : m_budget(budget), m_random(seed) {}

    Machine machine;
    std::vector<Car> cars;

    void addCars(int count) {
        for (int i = 0; i < count; ++i)
            cars.push_back({{20.0 + 600.0 * unit() * unit(), 0.3 + unit(), 1.0, 3.0 + 9.0 * unit()},
                            0.1 + 0.3 * unit(),
                            1e9,
                            true,
                            std::nullopt});
    }

    /// Milliseconds that the next picture takes.
    double frame() {
        m_budget.plan(demand());
        std::vector<MapUpdate> updates;
        for (Car& car : cars) {
            const Detail now = chooseDetail(car.view, {}, m_budget.coarse(), car.held);
            const bool better = car.held && !car.held->atLeast(now);
            car.held = now;
            updates.push_back({std::max(car.moved / now.reuse, better ? 1.0 : 0.0), car.view.pixels,
                               unitsOf(now), car.missing});
        }
        double units = 0.0, reflections = 0.0;
        for (const std::size_t i : chooseUpdates(updates, m_budget.allowedUnits())) {
            cars[i].moved = 0.0;
            cars[i].missing = false;
            units += updates[i].units;
            reflections += (machine.eachMap + machine.perUnit * updates[i].units) * noise();
        }
        drawn = units;
        for (Car& car : cars)
            car.moved += car.step;
        double all = machine.rest * noise() + reflections;
        if (unit() < machine.hiccup)
            all += 60.0;
        m_budget.took(all, {reflections, units});
        return all;
    }
    std::vector<double> frames(int count) {
        std::vector<double> out;
        for (int i = 0; i < count; ++i)
            out.push_back(frame());
        return out;
    }
    /// How often the coarseness changes in so many pictures.
    int changes(int count) {
        int changed = 0;
        for (int i = 0; i < count; ++i) {
            const int before = m_budget.coarse();
            static_cast<void>(frame());
            changed += m_budget.coarse() != before ? 1 : 0;
        }
        return changed;
    }
    [[nodiscard]] FrameBudget& budget() { return m_budget; }
    double drawn = 0.0;

private:
    double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(m_random); }
    double noise() { return 1.0 + machine.noise * (2.0 * unit() - 1.0); }
    [[nodiscard]] FrameBudget::Demand demand() const {
        FrameBudget::Demand out;
        for (int c = 0; c <= kMostCoarse; ++c) {
            const auto at = std::size_t(c);
            for (const Car& car : cars) {
                const Detail d = chooseDetail(car.view, {}, c);
                out.units[at] += unitsOf(d) * std::min(1.0, car.step / d.reuse);
                out.largest[at] = std::max(out.largest[at], unitsOf(d));
            }
        }
        return out;
    }

    FrameBudget m_budget;
    std::mt19937 m_random;
};

double worst(const std::vector<double>& frames) {
    return *std::max_element(frames.begin(), frames.end());
}

TEST(FrameBudget, ShowsAFewVehiclesAtFullQuality) {
    Street street(33.0);
    street.addCars(2);
    static_cast<void>(street.frames(100));
    EXPECT_EQ(street.budget().coarse(), 0);
    EXPECT_LE(worst(street.frames(500)), 33.0);
    EXPECT_EQ(street.budget().coarse(), 0);
}

TEST(FrameBudget, KeepsEvenTheWorstPictureWithinTheBudgetWithManyVehicles) {
    for (const int count : {5, 15, 30, 100}) {
        for (const double budget : {18.0, 25.0, 33.0, 60.0}) {
            Street street(budget, unsigned(count));
            street.addCars(count);
            static_cast<void>(street.frames(30));
            EXPECT_LE(worst(street.frames(1500)), budget) << count << " cars, " << budget << " ms";
        }
    }
}

TEST(FrameBudget, UsesTheTimeThatThereIs) {
    Street street(33.0);
    street.addCars(30);
    static_cast<void>(street.frames(100));
    double sum = 0.0;
    for (int i = 0; i < 500; ++i)
        sum += street.frame();
    EXPECT_GT(sum / 500.0, 0.6 * 33.0);
}

TEST(FrameBudget, SettlesAndDoesNotOscillate) {
    for (int count = 1; count < 120; count += 7) {
        for (const double perUnit : {1e-5, 5e-5, 2e-4}) {
            Street street(33.0, unsigned(count));
            street.machine.perUnit = perUnit;
            street.addCars(count);
            static_cast<void>(street.frames(600));
            EXPECT_LE(street.changes(1500), 2) << count << " cars, " << perUnit << " ms a unit";
        }
    }
}

TEST(FrameBudget, TakesAStepOfLoadWithinTwoPicturesAndRecoversWhenItGoes) {
    Street street(33.0);
    street.addCars(3);
    static_cast<void>(street.frames(200));
    ASSERT_EQ(street.budget().coarse(), 0);
    street.addCars(60);  // around the corner comes a column
    EXPECT_LE(worst(street.frames(400)), 33.0) << "not one picture is late";
    const int loaded = street.budget().coarse();
    EXPECT_GT(loaded, 0);
    street.cars.resize(3);
    static_cast<void>(street.frames(600));
    EXPECT_EQ(street.budget().coarse(), 0);
}

TEST(FrameBudget, GivesWayWhenEverythingElseGetsSlowerAndComesBack) {
    Street street(33.0);
    street.addCars(12);
    static_cast<void>(street.frames(300));
    const double before = street.budget().allowedMilliseconds();
    street.machine.rest = 24.0;
    static_cast<void>(street.frames(2));
    EXPECT_LE(worst(street.frames(400)), 33.0);
    EXPECT_LT(street.budget().allowedMilliseconds(), before);
    street.machine.rest = 12.0;
    static_cast<void>(street.frames(100));
    EXPECT_NEAR(street.budget().allowedMilliseconds(), before, 1.0);
}

TEST(FrameBudget, LetsOneHiccupPass) {
    Street street(33.0);
    street.addCars(6);
    static_cast<void>(street.frames(200));
    const int coarse = street.budget().coarse();
    const double allowed = street.budget().allowedMilliseconds();
    street.budget().took(200.0, {5.0, 1e5});
    EXPECT_NEAR(street.budget().allowedMilliseconds(), allowed, 0.5);
    static_cast<void>(street.frames(20));
    EXPECT_EQ(street.budget().coarse(), coarse);
}

TEST(FrameBudget, LearnsWhatAMachineCanDo) {
    for (const double perUnit : {1e-6, 1e-4, 5e-4}) {
        Street street(33.0);
        street.machine.perUnit = perUnit;
        street.machine.eachMap = 0.0;
        street.addCars(40);
        static_cast<void>(street.frames(60));
        EXPECT_NEAR(street.budget().millisecondsPerUnit(), perUnit, 0.1 * perUnit);
    }
}

TEST(FrameBudget, LearnsWhatOtherVehiclesInMapsCostApartFromTheMaps) {
    FrameBudget budget(50.0);
    for (int i = 0; i < 20; ++i)
        budget.took(30.0, {4.0, 1e5}, {8.0, 1e4});
    EXPECT_NEAR(budget.millisecondsPerUnit(), 4e-5, 1e-9);
    EXPECT_NEAR(budget.othersWeight(), 20.0, 1e-6);
    const double allowed = budget.allowedMilliseconds();
    for (int i = 0; i < 20; ++i)
        budget.took(22.0, {4.0, 1e5});
    EXPECT_NEAR(budget.othersWeight(), 20.0, 1e-6) << "none was drawn: nothing new is known";
    EXPECT_NEAR(budget.allowedMilliseconds(), allowed, 1e-9) << "18 ms are the rest of both";
}

TEST(FrameBudget, AlwaysDrawsSomethingHoweverSlowTheRestIs) {
    Street street(16.0);
    street.machine.rest = 90.0;
    street.addCars(20);
    static_cast<void>(street.frames(50));
    EXPECT_GT(street.budget().allowedMilliseconds(), 2.0);
    double units = 0.0;
    for (int i = 0; i < 50; ++i) {
        static_cast<void>(street.frame());
        units += street.drawn;
    }
    EXPECT_GT(units, 0.0);
}

TEST(FrameBudget, LeavesRoomForThePictureWhileThatIsDrawnSmaller) {
    FrameBudget budget(33.0);
    for (int i = 0; i < 10; ++i)
        budget.took(5.0, {});
    budget.plan({}, false);
    const double full = budget.allowedMilliseconds();
    budget.plan({}, true);
    EXPECT_LT(budget.allowedMilliseconds(), 0.5 * full);
}

TEST(FrameBudget, HoldsNothingBackWithoutABudget) {
    Street street(std::numeric_limits<double>::infinity());
    street.addCars(200);
    static_cast<void>(street.frames(50));
    EXPECT_EQ(street.budget().coarse(), 0);
    EXPECT_TRUE(std::isinf(street.budget().allowedUnits()));
}

TEST(FrameBudget, TakesSenselessFiguresForNone) {
    FrameBudget budget(1e-9);
    EXPECT_EQ(budget.budget(), LodSettings::kLeastBudget);
    budget.setBudget(std::nan(""));
    EXPECT_EQ(budget.budget(), LodSettings{}.frameBudget);
    const double allowed = budget.allowedMilliseconds();
    const double units = budget.allowedUnits();
    budget.took(std::nan(""), {1.0, 1.0});
    budget.took(1.0, {std::numeric_limits<double>::infinity(), 1.0});
    budget.took(-1.0, {1.0, 1.0});
    budget.took(1.0, {1.0, std::nan("")});
    budget.took(1.0, {1.0, 1.0}, {-1.0, 1.0});
    EXPECT_EQ(budget.allowedMilliseconds(), allowed);
    EXPECT_EQ(budget.allowedUnits(), units);
}

}  // namespace
}  // namespace reflet
