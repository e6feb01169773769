// The table of parameters: one row each, and nothing lists them a second time. From a row come the struct member that
// solvers read, the JSON key, --set, `curlew params`, the JSON schema, the README's table and the slider.
//
//   REAL(member, default, slider_min, slider_max, min, max, unit, symbol, when, doc)
//   COUNT(member, default, slider_min, slider_max, min, max, unit, symbol, when, doc)
//   FLAG(member, default, symbol, when, doc)
//   CHOICE(member, default, symbol, when, doc, names...)      the first name is number 0
//
// `when` is live (may change while running) or rebuild (needs the particles laid out anew).
// min and max are hard limits, wider than the slider. Documentation names the paper and equation.
#pragma once

#define CURLEW_SPH_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                           \
  CHOICE(kernel, cubic, "W", rebuild,                                                                              \
         "Smoothing kernel: cubic spline (Monaghan 1992), or Wendland's C2, which with sph.h_over_d = 1.1 is the " \
         "more accurate; in 3D a step takes some 15 % longer.",                                                    \
         cubic, wendland)                                                                                          \
  REAL(h_over_d, 1.0, 0.8, 2.0, 0.7, 3.0, "1", "h/d", rebuild,                                                     \
       "Smoothing length over particle spacing; the kernel reaches 2h. Bender & Koschier 2017 use 1.")             \
  REAL(rest_density, 1000.0, 100.0, 2000.0, 1e-3, 1e5, "kg/m^3", "rho_0", rebuild, "Density of the fluid at rest.")

#define CURLEW_PRESSURE_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                         \
  REAL(density_tolerance, 1e-4, 1e-5, 1e-2, 1e-7, 1.0, "1", "eta_rho", live,                                          \
       "Mean compression at which the density solve stops, as a fraction (Bender & Koschier 2017, section 3.3; "      \
       "0.01 % in Bender et al. 2018, section 7); in steps so short that gravity compresses by less, some of that.")  \
  REAL(divergence_tolerance, 1e-3, 1e-4, 1e-1, 1e-7, 1.0, "1", "eta_div", live,                                       \
       "Mean compression rate at which the divergence solve stops, as density change in one step (Bender et al. "     \
       "2018, section 7: 0.1 %).")                                                                                    \
  COUNT(max_iterations, 200, 10, 500, 1, 100000, "1", "", live,                                                       \
        "Most iterations of the density solve in a step; "                                                            \
        "reaching it is counted in limit_hits.")                                                                      \
  COUNT(max_divergence_iterations, 200, 10, 500, 0, 100000, "1", "", live,                                            \
        "Most iterations of the divergence solve in a step; 0 switches the solve off.")                               \
  COUNT(min_iterations, 1, 1, 20, 1, 1000, "1", "", live, "Fewest iterations of each solve in a step.")               \
  FLAG(warm_start, true, "", live,                                                                                    \
       "Begin each solve with the last step's pressure (Bender & Koschier 2017, "                                     \
       "section 3.5).")                                                                                               \
  FLAG(two_sided, false, "", live,                                                                                    \
       "Both signs of pressure where the neighbourhood is full, and density measured against its mean: for domains "  \
       "filled with fluid. Off, pressure only pushes, which is right at a free surface.")                             \
  REAL(shifting, 2.0, 0.0, 6.0, 0.0, 50.0, "1", "A", live,                                                            \
       "Strength of particle shifting where pressure is two-sided (Skillen et al. 2013 use 2); 0 skips the pass.")    \
  FLAG(conserving, true, "", live,                                                                                    \
       "Where pressure is two-sided: its force as the adjoint of the corrected divergence, and a second-order step "  \
       "for it. Keeps the energy of vortices that the plain step takes.")                                             \
  REAL(relative_tolerance, 0.3, 0.01, 1.0, 0.0, 1.0, "1", "", live,                                                   \
       "With pressure.conserving: share of the compression brought in by forces and motion at which the divergence "  \
       "solve stops, if pressure.divergence_tolerance has not asked for less.")                                       \
  REAL(reflection, 0.8, 0.0, 1.0, 0.0, 1.0, "1", "theta", live,                                                       \
       "With pressure.conserving: how much of the divergence solve's push acts a second time, after the particles "   \
       "have moved. 0 takes energy at every step, 1 takes none but lets pressures flicker (Zehnder et al. 2018).")    \
  CHOICE(solver, accelerated, "", live,                                                                               \
         "Iteration of both solves: relaxed Jacobi as in Bender & Koschier 2017, or the same with Nesterov momentum " \
         "and adaptive restart (O'Donoghue & Candes 2015), which needs fewer sweeps. The divergence solve of "        \
         "pressure.conserving uses neither, but conjugate gradients.",                                                \
         jacobi, accelerated)

#define CURLEW_VISCOSITY_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                     \
  REAL(nu, 0.0, 0.0, 0.05, 0.0, 100.0, "m^2/s", "nu", live,                                                        \
       "Kinematic viscosity, explicit; 0 skips the pass. Water has 1e-6, which no affordable spacing resolves.")   \
  CHOICE(form, scalar, "", live,                                                                                   \
         "Laplacian of the velocity: scalar form (exact isotropy, Brookshaw 1985) or vector form (Monaghan 1992, " \
         "Liu et al. 2020 Eq. 4), which conserves angular momentum.",                                              \
         scalar, vector)

#define CURLEW_MICROPOLAR_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                        \
  REAL(nu_t, 0.0, 0.0, 0.5, -1e3, 1e3, "m^2/s", "nu_t", live,                                                          \
       "Transfer between the flow and the particles' spin (Bender et al. 2018, Eq. 6 to 9; they use 0.05 to 0.4); 0 "  \
       "switches the inviscid model off, minus viscosity.nu the full one.")                                            \
  CHOICE(model, inviscid, "", live,                                                                                    \
         "Inviscid as in the paper's scenes (Eq. 8, 9), or full, with viscosity.nu and zeta (Eq. 6, 7).", inviscid,    \
         full)                                                                                                         \
  CHOICE(curls, difference, "", live,                                                                                  \
         "The two curls: difference form for both as in the paper; symmetric for both; or conjugate, the symmetric "   \
         "one in the force and the difference one in the spin, adjoint to each other, which conserves momentum.",      \
         difference, symmetric, conjugate)                                                                             \
  REAL(torque_x, 0.0, -1.0, 1.0, -1e6, 1e6, "m^2/s^2", "tau_x", live, "External torque per mass (Eq. 7), x.")          \
  REAL(torque_y, 0.0, -1.0, 1.0, -1e6, 1e6, "m^2/s^2", "tau_y", live, "External torque per mass (Eq. 7), y.")          \
  REAL(torque_z, 0.0, -1.0, 1.0, -1e6, 1e6, "m^2/s^2", "tau_z", live, "External torque per mass (Eq. 7), z.")          \
  REAL(theta, 2.0, 0.1, 10.0, 1e-12, 1e6, "m^2", "Theta", live, "Microinertia (Bender et al. 2018 use 2).")            \
  REAL(zeta, 0.0, 0.0, 1.0, 0.0, 1e3, "m^4/s", "zeta", live, "Diffusion of the spin in the full model (Eq. 7).")       \
  REAL(eta, 0.125, 0.0, 0.5, 0.0, 1.0, "1", "eta", live,                                                               \
       "XSPH smoothing of the spin (Bender et al. 2018, section 5: 0.125), where the model is on.")                    \
  REAL(gamma, 0.0, 0.0, 0.1, 0.0, 1.0, "1", "gamma", live,                                                             \
       "XSPH smoothing of the velocity (Bender et al. 2018, section 5; they use 0.002); 0 skips the pass.")            \
  CHOICE(xsph_form, rate, "", live,                                                                                    \
         "XSPH as a rate (gamma and eta per xsph_reference_step, the same under any time step) or per step as in the " \
         "paper.",                                                                                                     \
         rate, step)                                                                                                   \
  REAL(xsph_reference_step, 1e-3, 1e-4, 1e-2, 1e-6, 1.0, "s", "", live,                                                \
       "Time step to which gamma and eta of the rate form "                                                            \
       "refer.")

#define CURLEW_VORTICITY_REFINEMENT_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                             \
  REAL(alpha, 0.0, 0.0, 1.5, 0.0, 1e3, "1", "alpha", live,                                                            \
       "Share of the vorticity that each step loses which is given back (Liu et al. 2020, Eq. 17; they use 1 to 1.2 " \
       "and call 1.3 unstable); 0 skips the passes.")                                                                 \
  CHOICE(reconstruction, poisson, "", live,                                                                           \
         "From vorticity to velocity: the paper's sum over neighbours (Eq. 15), which gives back small eddies in "    \
         "part and large ones hardly, or Poisson's equation on a grid, which gives back all that the grid resolves.", \
         poisson, sum)

#define CURLEW_VORTICITY_CONFINEMENT_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                          \
  REAL(epsilon, 0.0, 0.0, 0.5, 0.0, 1e3, "m/s", "epsilon", live,                                                    \
       "Push along the swirl of each vortex, in m/s^2 for a vorticity of 1/s (Macklin & Mueller 2013, section 5); " \
       "adds energy without a limit; 0 skips the passes.")

#define CURLEW_WAVELET_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                           \
  REAL(                                                                                                                \
      amplitude, 0.0, 0.0, 5.0, 0.0, 1e6, "s/m", "A", live,                                                            \
      "Strength of wavelet turbulence (Fujisawa et al. 2011, Eq. 9): eddies smaller than the flow resolves, where it " \
      "has energy at the scale of its particles; 0 skips the passes.")                                                 \
  CHOICE(                                                                                                              \
      form, rate, "", live,                                                                                            \
      "Acceleration A e y / tau (rate), the same whatever the time step, or with the step in place of tau, as in the " \
      "paper.",                                                                                                        \
      rate, step)                                                                                                      \
  REAL(reference_step, 1e-3, 1e-4, 1e-2, 1e-6, 1.0, "s", "tau", live, "Time of the rate form.")                        \
  REAL(scale, 0.5, 0.3, 0.6, 0.2, 0.6, "d", "s", live,                                                                 \
       "Scale of the wavelet (Eq. 6) that finds the turbulence, in spacings; beyond 0.6 it would reach past the "      \
       "neighbours, which end at twice sph.h_over_d.")                                                                 \
  COUNT(octaves, 2, 1, 4, 1, 8, "1", "", live,                                                                         \
        "Bands of the turbulence that is put in (Eq. 8): the finest has cells of one spacing, each other twice the "   \
        "size of the one before.")                                                                                     \
  REAL(threshold, 1e-3, 0.0, 0.1, 0.0, 1e6, "m^2/s^2", "", live,                                                       \
       "Wavelet energy that counts as calm: only what is above it acts.")                                              \
  REAL(                                                                                                                \
      renewal, 1.0, 0.0, 4.0, 0.0, 1e3, "1", "", live,                                                                 \
      "How many of its cells the noise moves on in an eddy's turnover time; 0 leaves it where it is, where it drives " \
      "standing jets.")                                                                                                \
  COUNT(tile, 64, 32, 128, 32, 256, "1", "", rebuild,                                                                  \
        "Cells of the noise along each axis before it repeats: 32, 64, 128 or 256 (0.6, 5, 35, 275 MB).")

#define CURLEW_SUB_PARTICLE_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                     \
  COUNT(levels, 0, 0, 3, 0, 3, "1", "L_max", live,                                                                    \
        "Most levels of vortex sub-particles (Fujisawa et al. 2011, section 3.4): 3 splits a particle at a lively "   \
        "surface into eight; 0 skips the passes.")                                                                    \
  REAL(critical_energy, 0.02, 1e-3, 0.2, 1e-9, 1e6, "m^2/s^2", "e_cri", live,                                         \
       "Wavelet energy from which on particles split (Eq. 13); 1.47 times as much for each further level.")           \
  REAL(rise, 0.03, 0.005, 0.2, 1e-6, 1e3, "s", "", live, "Time in which levels follow a rising energy.")              \
  REAL(decay, 0.25, 0.05, 2.0, 1e-6, 1e3, "s", "", live,                                                              \
       "Time in which levels follow a falling energy: eddies outlive what fed them by so much, and then the surface " \
       "is "                                                                                                          \
       "smooth again.")

#define CURLEW_ENERGY_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                            \
  FLAG(guard, true, "", live,                                                                                          \
       "Keeps the turbulence models together from adding more energy than energy.share of what the solver has lost. "  \
       "Off, they do as in their papers and may grow without a limit.")                                                \
  REAL(share, 0.25, 0.0, 1.0, 0.0, 1.0, "1", "", live,                                                                 \
       "Share of what the solver has lost that the models may give back under the guard. Splashes lose energy in "     \
       "nature too; 1 suits flows without a surface.")                                                                 \
  REAL(memory, 0.25, 0.05, 1.0, 1e-3, 1e6, "s", "tau", live,                                                           \
       "Time in which the guard forgets energy that was lost and not given back: old losses cannot be spent in still " \
       "water.")

#define CURLEW_TIME_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                             \
  REAL(cfl, 0.3, 0.1, 1.0, 0.01, 10.0, "1", "", live,                                                                 \
       "Farthest that a particle may move in a step, in particle "                                                    \
       "spacings (Monaghan 1992).")                                                                                   \
  REAL(acceleration_factor, 0.25, 0.05, 1.0, 0.01, 10.0, "1", "", live,                                               \
       "Step limit from acceleration: factor times sqrt(d / |a|) (Monaghan 1992).")                                   \
  REAL(viscosity_factor, 0.125, 0.01, 0.25, 0.001, 10.0, "1", "", live,                                               \
       "Step limit from explicit viscosity: factor times d^2 / nu (Morris et al. 1997).")                             \
  REAL(growth, 1.1, 1.01, 2.0, 1.001, 1000.0, "1", "", live, "Most that a step may grow over the one before.")        \
  REAL(max_step, 5e-3, 1e-4, 2e-2, 1e-9, 10.0, "s", "dt", live, "Largest time step that the limits may choose.")      \
  REAL(fixed_step, 0.0, 0.0, 1e-2, 0.0, 10.0, "s", "dt", live, "Fixed time step; 0 chooses the step by the limits.")  \
  REAL(max_displacement, 5.0, 1.0, 10.0, 0.1, 1e6, "d", "", live,                                                     \
       "A particle that would move farther than this in one step, in spacings, has diverged: the run stops.")         \
  REAL(max_speed, 20.0, 2.0, 100.0, 1.0, 1e6, "1", "", live,                                                          \
       "A particle faster than this many times what the scene can bring forth (speed at the start, of moving walls, " \
       "of moving bodies, of a fall through the domain) has diverged: the run stops.")                                \
  REAL(max_energy, 2.0, 1.1, 10.0, 1.0, 1e6, "1", "", live,                                                           \
       "Water with more than this many times the mechanical energy of the start has diverged: the run stops. Not "    \
       "where walls or bodies move, a torque acts, or turbulence models run without energy.guard.")

#define CURLEW_SURFACE_PARAMETERS(REAL, COUNT, FLAG, CHOICE)                                                      \
  REAL(cell, 1.0, 0.5, 2.0, 0.5, 2.0, "r", "", live,                                                              \
       "Width of the marching-cubes cells of the water's surface, in particle radii.")                            \
  REAL(kernel_radius, 2.0, 1.2, 2.0, 1.0, 4.0, "d", "R", live,                                                    \
       "Reach of a particle in the surface's level set, in spacings: larger is smoother and loses thin sheets.")  \
  REAL(iso, 0.5, 0.3, 0.7, 0.05, 0.95, "1", "", live,                                                             \
       "Level of the surface, as a share of full water: half keeps the volume.")                                  \
  COUNT(smoothing, 2, 0, 20, 0, 1000, "1", "", live,                                                              \
        "Smoothing passes over the surface's mesh, which keep its volume (Taubin 1995).")                         \
  FLAG(anisotropic, false, "", live,                                                                              \
       "Particles flattened into the shape of their surroundings (Yu & Turk 2013): smoother surfaces and sheets " \
       "without holes, for stills, at several times the cost.")

// group name, struct, table, heading
#define CURLEW_PARAMETER_GROUPS(GROUP)                                                                  \
  GROUP(sph, SphParameters, CURLEW_SPH_PARAMETERS, "Discretisation")                                    \
  GROUP(pressure, PressureParameters, CURLEW_PRESSURE_PARAMETERS, "Pressure (DFSPH)")                   \
  GROUP(viscosity, ViscosityParameters, CURLEW_VISCOSITY_PARAMETERS, "Viscosity")                       \
  GROUP(micropolar, MicropolarParameters, CURLEW_MICROPOLAR_PARAMETERS, "Micropolar and XSPH")          \
  GROUP(vorticity_refinement, VorticityRefinementParameters, CURLEW_VORTICITY_REFINEMENT_PARAMETERS,    \
        "Vorticity refinement")                                                                         \
  GROUP(vorticity_confinement, VorticityConfinementParameters, CURLEW_VORTICITY_CONFINEMENT_PARAMETERS, \
        "Vorticity confinement")                                                                        \
  GROUP(wavelet, WaveletParameters, CURLEW_WAVELET_PARAMETERS, "Wavelet turbulence")                    \
  GROUP(sub_particles, SubParticleParameters, CURLEW_SUB_PARTICLE_PARAMETERS, "Vortex sub-particles")   \
  GROUP(energy, EnergyParameters, CURLEW_ENERGY_PARAMETERS, "Energy guard")                             \
  GROUP(time, TimeParameters, CURLEW_TIME_PARAMETERS, "Time step")                                      \
  GROUP(surface, SurfaceParameters, CURLEW_SURFACE_PARAMETERS, "Surface")
