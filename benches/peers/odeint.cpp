// Boost.odeint on the two-mass model: dopri5 with dense output, events located on it by TOMS 748, one instance at a time.
// Built by peer_odeint.py: c++ -O3 -march=native. Arguments: tolerance, settle and measure in periods, samples per period;
// rows of mu_s mu_d V kick on standard input; a line of std x2 for each, then the CPU seconds.
// All in scaled units (time 1/w0, length F/k2, mass m2 + m1 c^2), as model.py has them, whose constants come first on the input.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint.hpp>
using namespace boost::numeric::odeint;
using State = std::array<double, 6>;  // x2 y2 y1 and their velocities
enum Mode { SLIP, STICK, FREE };
static double m1, s, c, k1, k2, c1, c2, F, vk, a00, i00, i01, i11, V0, L0;
static const double OFF = 1e-11;

struct Brake {
    double V, mu_s, mu_d, sigma;
    Mode mode;
    bool far;  // beyond the knee of the law
    double mu(double v) const { return far ? mu_d : mu_s + (mu_d - mu_s)*std::fabs(v)/vk; }
    void forces(const State &x, double &h, double &R, double &W) const {
        h = k2*(x[0]*s + x[1]*c - x[2]) + c2*(x[3]*s + x[4]*c - x[5]);
        double g = k1*(x[0]*c - x[1]*s) + c1*(x[3]*c - x[4]*s);
        R = c*g + s*h; W = c*h - s*g;
    }
    double slip(const State &x, double R, double W) const { double q = sigma*mu(V - x[3]); return (q*W - R)/(a00 + q*m1*c*s); }
    void operator()(const State &x, State &dx, double) const {
        double h, R, W; forces(x, h, R, W);
        dx = {x[3], x[4], x[5], 0, 0, (h - F)/m1};
        if (mode == SLIP) dx[3] = slip(x, R, W);
        if (mode == FREE) { dx[3] = -(i00*R + i01*W); dx[4] = -(i01*R + i11*W); }
    }
    double normal(const State &x) const { double h, R, W; forces(x, h, R, W); return mode == SLIP ? W - s*c*m1*slip(x, R, W) : W; }
    // Event functions, positive inside the mode; the present contact state ends when one falls below 0.
    double least(const State &x) const {
        if (mode == FREE) return x[1];
        double h, R, W; forces(x, h, R, W);
        if (mode == STICK) return std::fmin(mu_s*W - std::fabs(R), W);
        double speed = sigma*(V - x[3]), knee = mu_s == mu_d ? 1.0 : far ? speed - vk : vk - speed;
        return std::fmin(std::fmin(speed, normal(x)), knee);
    }
    void enter_slip(State &x, double sg) {
        sigma = sg; far = std::fabs(V - x[3]) >= vk; mode = SLIP;
        if (normal(x) <= 0) { mode = FREE; x[1] = OFF; x[4] = 0; }
    }
    void at_rest(State &x) {
        double h, R, W; x[3] = V; forces(x, h, R, W);
        if (std::fabs(R) <= mu_s*W) { mode = STICK; return; }
        double sg = R > 0 ? 1 : -1; x[3] = V - sg*OFF; enter_slip(x, sg);
    }
    void event(State &x) {
        if (mode == FREE) {
            double v = V - x[3], sg = v > 0 ? 1 : -1; far = std::fabs(v) >= vk;
            double q = sg*mu(v), P = -x[4]/(i11 + i01*q), after = x[3] + (i00*q + i01)*P;
            x[1] = x[4] = 0;
            if ((V - after)*sg <= 0) at_rest(x); else { x[3] = after; enter_slip(x, sg); }
        } else if (mode == STICK) at_rest(x);
        else if (normal(x) <= OFF) { mode = FREE; x[1] = OFF; x[4] = 0; }
        else if (sigma*(V - x[3]) <= OFF) at_rest(x);
        else { far = !far; }
    }
};

int main(int, char **argument) {
    double tolerance = atof(argument[1]), period = 2*M_PI, settle = atof(argument[2])*period, measure = atof(argument[3])*period;
    int per = atoi(argument[4]), samples = (int)(atof(argument[3])*per) + 1;
    for (double *constant : {&m1, &s, &c, &k1, &k2, &c1, &c2, &F, &vk, &a00, &i00, &i01, &i11, &V0, &L0}) if (scanf("%lf", constant) != 1) return 1;
    double mu_s, mu_d, V, kick;
    clock_t began = clock();
    while (scanf("%lf %lf %lf %lf", &mu_s, &mu_d, &V, &kick) == 4) {
        Brake brake{V/V0, mu_s, mu_d, 1, SLIP, V/V0 >= vk};
        double mu = brake.mu(V/V0), x2 = F*(mu*c - s)/(c + mu*s)/(k1*c);
        State x = {x2, 0, x2*s - F/k2, kick/V0, 0, 0};
        brake.enter_slip(x, brake.V > x[3] ? 1 : -1);
        double t = 0, end = settle + measure, sum = 0, square = 0, h = 0.1;
        int next = 0;
        auto dense = make_dense_output(tolerance, tolerance, runge_kutta_dopri5<State>());
        auto sample = [&](const State &y) { double d = y[0] - x2; sum += d; square += d*d; next++; };
        while (t < end) {
            dense.initialize(x, t, h);
            for (;;) {
                auto step = dense.do_step(std::ref(brake));
                State y = dense.current_state();
                double low = step.first, high = step.second;
                bool left = brake.least(y) < 0;
                State middle;
                if (!left) { dense.calc_state(0.5*(low + high), middle); if (brake.least(middle) < 0) { left = true; high = 0.5*(low + high); } }
                double stop = high;
                if (left) {
                    auto least = [&](double at) { dense.calc_state(at, middle); return brake.least(middle); };
                    auto close = [&](double a, double b) { return b - a < 1e-13*end; };
                    double a = least(low), b = least(high);
                    boost::uintmax_t most = 60;
                    if (a > 0) stop = boost::math::tools::toms748_solve(least, low, high, a, b, close, most).second;
                    else {  // the step began at the last event: halve it until something is found
                        while (!close(low, high)) { double at = 0.5*(low + high); if (least(at) < 0) high = at; else low = at; }
                        stop = high;
                    }
                }
                for (double at; next < samples && (at = settle + next*period/per) <= stop; ) { dense.calc_state(at, middle); sample(middle); }
                if (stop >= end) { t = end; break; }
                if (left) {
                    dense.calc_state(stop, x);
                    t = stop; h = std::fmin(dense.current_time_step(), 0.3);
                    brake.event(x);
                    break;
                }
            }
        }
        double mean = sum/next;
        printf("%.17g\n", std::sqrt(square/next - mean*mean)*L0);
    }
    printf("%.6f\n", double(clock() - began)/CLOCKS_PER_SEC);
}
