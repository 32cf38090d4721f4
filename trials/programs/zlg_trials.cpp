// Campaigns that hold the product against bounds: tables in Markdown to stdout.
//
// usage: zlg_trials NAME [ARGUMENTS]
//
// Exit 1 where a limit is missed, 2 for a wrong command line, 3 for what was thrown.

#include <exception>
#include <map>

#include <fmt/format.h>

#include "campaigns.hpp"

namespace {

using namespace zlg::trials;

struct Campaign {
    const char* name;
    const char* measures;
    Work (*work)(CLI::App&);
};

constexpr Campaign campaigns[] = {
    {"accuracy", "Error of a switch, every method on the same records beside the bound", accuracy},
    {"manoeuvres", "Error of a switch at the first manoeuvre of a gyro whose motion was known", manoeuvres},
    {"sigma", "Error of a switch over its sigma, random gyros in random steady motions", sigma},
    {"faults", "Random faults in closed loop: found, missed, recovered from", faults},
    {"gyros", "Random gyros without faults in closed loop", gyros},
    {"environment", "Gyros in changing temperature and field", environment},
    {"drift", "Drift of long runs in closed loop", drift},
    {"magnetic", "The magnetic estimator on bases that move", magnetic},
    {"events", "Gyros by halves and from event to event: the same law of their errors", events},
    {"intervals", "The optimal interval between switches against others", intervals},
    {"noise", "Noise terms of random gyros, fitted, against the truth", noise_terms},
    {"accept", "Verdicts of acceptance tests against the truth", accept_units},
    {"processor", "The image of the processor against this program, bit by bit", processor_bits},
#ifdef ZLG_HAS_MPFR
    {"maths", "Elementary functions against MPFR", maths},
#endif
};

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Campaigns that hold the product against bounds", "zlg_trials"};
    app.require_subcommand(1);
    std::map<const CLI::App*, Work> works;
    for (const Campaign& c : campaigns) {
        CLI::App* const of_campaign = app.add_subcommand(c.name, c.measures);
        works[of_campaign] = c.work(*of_campaign);
    }
    try {
        app.parse(argc, argv);
        return works.at(app.get_subcommands().front())();
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "zlg_trials: {}\n", error.what());
        return 3;
    }
}
