#ifndef signoton_drivers_model_h
#define signoton_drivers_model_h

#include <signoton/base/ledger.h>
#include <signoton/discretization/point_locator.h>
#include <signoton/drivers/analysis.h>
#include <signoton/drivers/load_watch.h>
#include <signoton/operators/mechanics.h>
#include <signoton/operators/point_forces.h>
#include <signoton/solvers/newton.h>

namespace Signoton
{
  /** What a scene asks to be written and measured. */
  struct OutputParameters
  {
    void
    add_parameters(ParameterHandler &handler);

    std::string  directory        = "";
    bool         nodal_stress     = true;
    unsigned int checkpoint_every = 0;
    std::string  probe_text       = "";
    std::string  probe_quantities = "displacement, velocity";
    std::string  surface_text     = "";
    std::string  transect_text    = "";
  };

  /** Points on a straight line, evenly spaced: `Probe lines`. */
  template <int dim>
  struct Transect
  {
    Point<dim>                         from, to;
    unsigned int                       n_points = 2;
    std::unique_ptr<PointLocator<dim>> places;

    std::vector<Point<dim>>
    points() const
    {
      std::vector<Point<dim>> result;
      for (unsigned int i = 0; i < n_points; ++i)
        result.push_back(from + (double(i) / (n_points - 1)) * (to - from));
      return result;
    }
  };

  /**
   * Everything a scene consists of once it is built; drivers work on it.
   */
  template <int dim>
  struct Model
  {
    explicit Model(const MPI_Comm &communicator)
      : communicator(communicator)
      , ledger(communicator)
    {}

    MPI_Comm                                communicator;
    SceneFile                               file;
    Ledger                                  ledger;
    Geometry                                geometry;
    std::vector<Rheology::Material>         materials;
    BoundaryConditions<dim>                 conditions;
    std::vector<PointForce<dim>>            point_forces;
    std::unique_ptr<SpaceTimeFunction<dim>> gravity;
    /** An exact displacement to compare with, if the scene gives one. */
    std::unique_ptr<SpaceTimeFunction<dim>> reference;
    /** The same for the velocity, in dynamics. */
    std::unique_ptr<SpaceTimeFunction<dim>> reference_velocity;
    std::vector<Point<dim>>                 probes;
    std::vector<Transect<dim>>              transects;
    /** Names and ids of boundaries. */
    std::vector<std::pair<std::string, types::boundary_id>> probe_surfaces;
    /** The state before anything moves, if the scene gives one; strains and
     *  stresses in the components that the embedding has. */
    std::unique_ptr<SpaceTimeFunction<dim>> initial_strain, initial_stress;
    std::unique_ptr<SpaceTimeFunction<dim>> initial_velocity;
    std::unique_ptr<Analysis<dim>>          analysis;
    TimesToMeet                             times_to_meet;
    LoadWatch<dim>                          load_watch;
    Newton::Parameters                      newton;
    LinearSolver::Parameters                linear_solver;
    OutputParameters                        output;
    std::string                             resolved_scene;

    std::unique_ptr<Space<dim>>     space;
    std::unique_ptr<Mechanics<dim>> mechanics;
    /** Where probes and point forces are; nullptr if there are none. */
    std::unique_ptr<PointLocator<dim>> probe_points, force_points;

    /** Where what points remember goes to another mesh or a checkpoint, made
     *  when it is asked for; nullptr if they remember nothing. Collective. */
    PointSpace<dim> *
    history_space()
    {
      const unsigned int width = mechanics->state_width();
      if (width == 0)
        return nullptr;
      if (!history_points)
        history_points = std::make_unique<PointSpace<dim>>(*space, width);
      history_points->update();
      return history_points.get();
    }

    void
    set_time(const double time)
    {
      for (auto &condition : conditions)
        condition.set_time(time);
      for (auto &point : point_forces)
        if (point.force)
          point.force->set_time(time);
      if (gravity)
        gravity->set_time(time);
      if (reference)
        reference->set_time(time);
      if (reference_velocity)
        reference_velocity->set_time(time);
    }

  private:
    std::unique_ptr<PointSpace<dim>> history_points;
  };
} // namespace Signoton

#endif
