#include <signoton/discretization/periodic_vertices.h>
#include <signoton/discretization/refinement.h>
#include <signoton/discretization/wave_refinement.h>

#include <deal.II/grid/grid_tools.h>

#include <optional>

namespace Signoton
{
  void
  WaveRefinement::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Refinement");
    handler.add_parameter(
      "Follow waves",
      follow,
      "Refine at fronts and ahead of them, coarsen behind.");
    handler.add_parameter(
      "Every",
      every,
      "Look at the mesh every n-th step; ahead of fronts it "
      "is fine as far as waves go until then.",
      Patterns::Integer(1));
    handler.add_parameter("Refine threshold",
                          refine_threshold,
                          "Refine cells to whose neighbors the traction jumps "
                          "by more than this part of the largest jump. Waves "
                          "that have faded to a hundredth of the largest so "
                          "far are let go.",
                          Patterns::Double(0., 1.));
    handler.add_parameter("Coarsen threshold",
                          coarsen_threshold,
                          "Coarsen cells with jumps below this part.",
                          Patterns::Double(0., 1.));
    handler.add_parameter("Maximum level",
                          maximum_level,
                          "Finest level; the coarse mesh is level 0.",
                          Patterns::Integer(0, 20));
    handler.add_parameter("Minimum level",
                          minimum_level,
                          "Coarsest level; if not given, that of the initial "
                          "refinement.",
                          Patterns::Integer(0, 20));
    handler.add_parameter("Maximum unknowns",
                          maximum_unknowns,
                          "The refinement threshold rises where the mesh would "
                          "get more unknowns than about this.",
                          Patterns::Integer(1));
    handler.leave_subsection();
  }

  void
  WaveRefinement::check(const SceneFile &file) const
  {
    if (follow && minimum_level >= maximum_level)
      throw UserError(file.where({"Refinement"}, "Maximum level"),
                      std::to_string(maximum_level),
                      "more than 'Minimum level', here " +
                        std::to_string(minimum_level),
                      "without 'Minimum level', it is 'Geometry / Initial "
                      "refinement'");
    if (follow && coarsen_threshold > 0.5 * refine_threshold)
      throw UserError(file.where({"Refinement"}, "Coarsen threshold"),
                      file.value({"Refinement"}, "Coarsen threshold", "0.02"),
                      "at most half of 'Refine threshold', here " +
                        file.value({"Refinement"}, "Refine threshold", "0.1"),
                      "or cells are coarsened and refined in turns");
  }

  template <int dim>
  double
  WaveRefinement::finest_part(const Space<dim> &space) const
  {
    const int missing = static_cast<int>(maximum_level) -
                        (static_cast<int>(space.mesh.n_global_levels()) - 1);
    return follow && missing > 0 ? std::ldexp(1., -missing) : 1.;
  }

  namespace
  {
    /** Where a wave may come from, and how far it gets, in m. */
    template <int dim>
    struct Origin
    {
      Point<dim> center;
      double     radius = -1.; ///< negative for none

      double
      to_go(const Point<dim> &p) const
      {
        return radius - center.distance(p);
      }

      /** Also what is just touched, whatever the round-off. */
      bool
      reaches(const Point<dim> &p) const
      {
        return to_go(p) >= -1e-9 * radius;
      }

      /** Whether a wave from here has more to go at a point. One of two equals
       *  is chosen by its place, to be the same on any number of ranks; equal
       *  are origins that differ by round-off, as images across a periodic
       *  boundary and back do. */
      bool
      is_better(const Origin &other, const Point<dim> &p) const
      {
        if (other.radius < 0.)
          return true;
        const double more  = to_go(p) - other.to_go(p);
        const double noise = 1e-9 * radius;
        if (center.distance(other.center) < noise)
          return more > noise;
        if (std::abs(more) > noise)
          return more > 0.;
        return std::lexicographical_compare(center.begin_raw(),
                                            center.end_raw(),
                                            other.center.begin_raw(),
                                            other.center.end_raw());
      }

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &center &radius;
      }
    };

    /** What waves from some cells can reach. */
    template <int dim>
    class Reach
    {
    public:
      explicit Reach(const parallel::distributed::Triangulation<dim> &mesh)
        : mesh(mesh)
        , center(mesh.n_active_cells())
        , vertices(mesh.n_active_cells())
        , images(periodic_vertices(mesh))
      {
        for (const auto &cell : mesh.active_cell_iterators())
          if (!cell->is_artificial())
            {
              const unsigned int i = cell->active_cell_index();
              (cell->is_locally_owned() ? own : ghosts).push_back(i);
              center[i] = cell->center();
              for (const auto v : cell->vertex_indices())
                vertices[i][v] = cell->vertex_index(v);
            }
      }

      /** The cells that are touched from own cells within their distances, by
       *  active cell index; those with a negative one are no sources. On any
       *  number of ranks. */
      std::vector<bool>
      operator()(const std::vector<double> &distance)
      {
        const auto               &points = mesh.get_vertices();
        std::vector<Origin<dim>>  of_cell(distance.size());
        std::vector<Origin<dim>>  of_vertex(points.size());
        std::vector<unsigned int> news; // cells
        for (const unsigned int i : own)
          if (distance[i] >= 0.)
            {
              of_cell[i] = {center[i],
                            distance[i] +
                              center[i].distance(points[vertices[i][0]])};
              news.push_back(i);
            }
        std::vector<bool> is_new(points.size());
        for (bool changes = true; changes;)
          {
            GridTools::exchange_cell_data_to_ghosts<Origin<dim>>(
              mesh,
              [&](const auto &cell) {
                return std::optional<Origin<dim>>(
                  of_cell[cell->active_cell_index()]);
              },
              [&](const auto &cell, const Origin<dim> &origin) {
                of_cell[cell->active_cell_index()] = origin;
              });
            for (const auto *cells : {&news, &ghosts})
              for (const unsigned int i : *cells)
                if (of_cell[i].radius >= 0.)
                  for (const unsigned int v : vertices[i])
                    if (of_cell[i].reaches(points[v]) &&
                        of_cell[i].is_better(of_vertex[v], points[v]))
                      {
                        of_vertex[v] = of_cell[i];
                        is_new[v]    = true;
                      }
            bool crossed = false;
            for (const auto &[from, to, shift] : images)
              if (Origin<dim> image = of_vertex[from]; image.radius >= 0.)
                {
                  image.center += shift;
                  if (image.is_better(of_vertex[to], points[to]))
                    {
                      of_vertex[to] = image;
                      is_new[to]    = true;
                      crossed       = true;
                    }
                }
            news.clear();
            for (const unsigned int i : own)
              {
                bool better = false;
                for (const unsigned int v : vertices[i])
                  if (is_new[v] &&
                      of_vertex[v].is_better(of_cell[i], center[i]))
                    {
                      of_cell[i] = of_vertex[v];
                      better     = true;
                    }
                if (better)
                  news.push_back(i);
              }
            is_new.assign(points.size(), false);
            changes = Utilities::MPI::max(news.empty() && !crossed ? 0U : 1U,
                                          mesh.get_communicator()) > 0;
          }
        std::vector<bool> reached(of_cell.size());
        for (unsigned int i = 0; i < reached.size(); ++i)
          reached[i] = of_cell[i].radius >= 0.;
        return reached;
      }

    private:
      static constexpr unsigned int n_vertices =
        GeometryInfo<dim>::vertices_per_cell;

      const parallel::distributed::Triangulation<dim>  &mesh;
      std::vector<unsigned int>                         own, ghosts;
      std::vector<Point<dim>>                           center;
      std::vector<std::array<unsigned int, n_vertices>> vertices;
      std::vector<PeriodicVertex<dim>>                  images;
    };

    /** Coarsening that is worth a new mesh, as a part of all cells. */
    constexpr double worthwhile = 0.1;

    /** Waves that have faded to this part of the largest are let go. */
    constexpr double faded = 0.01;
  } // namespace

  template <int dim>
  std::vector<unsigned int>
  WaveRefinement::needed_levels(
    const parallel::distributed::Triangulation<dim> &mesh,
    const std::vector<double>                       &jump,
    const double                                     threshold,
    const double                                     distance) const
  {
    std::vector<unsigned int> wanted(jump.size(), 0), needed(jump.size(), 0);
    unsigned int              finest = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      if (const unsigned int i = cell->active_cell_index();
          cell->is_locally_owned() && jump[i] >= threshold)
        {
          // where the solution is smooth the jump goes with the size
          const double more =
            std::ceil(std::log2(1.0001 * jump[i] / threshold));
          wanted[i] =
            std::min<double>(maximum_level, cell->level() + std::max(more, 0.));
          finest = std::max(finest, wanted[i]);
        }
    finest = Utilities::MPI::max(finest, mesh.get_communicator());
    // Cells are refined by one level at a time: the coarser they are, the earlier.
    Reach<dim>          reach(mesh);
    std::vector<double> from(jump.size());
    for (unsigned int level = finest; level > minimum_level; --level)
      {
        for (unsigned int i = 0; i < from.size(); ++i)
          from[i] =
            wanted[i] >= level ? (1. + wanted[i] - level) * distance : -1.;
        const std::vector<bool> reached = reach(from);
        for (unsigned int i = 0; i < needed.size(); ++i)
          if (reached[i])
            needed[i] = std::max(needed[i], level);
      }
    return needed;
  }

  template <int dim>
  bool
  WaveRefinement::mark(Space<dim>          &space,
                       std::vector<double> &jump,
                       const double         distance,
                       double              &largest_of_run) const
  {
    auto  &mesh    = space.mesh;
    double largest = 0.;
    for (double &value : jump)
      if (value > 0.)
        {
          // half percent steps: equal on any number of ranks
          value   = std::exp(std::round(200. * std::log(value)) / 200.);
          largest = std::max(largest, value);
        }
    largest        = Utilities::MPI::max(largest, space.communicator);
    largest_of_run = std::max(largest_of_run, largest);
    largest        = std::max(largest, faded * largest_of_run);
    if (!(largest > 0.))
      return false;

    double threshold = refine_threshold;
    double n_refined = 0., n_coarsened = 0.;
    while (true)
      {
        const std::vector<unsigned int> needed =
          needed_levels(mesh, jump, threshold * largest, distance);
        for (const auto &cell : mesh.active_cell_iterators())
          {
            cell->clear_refine_flag();
            cell->clear_coarsen_flag();
          }
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned() &&
              needed[cell->active_cell_index()] <
                static_cast<unsigned int>(cell->level()) &&
              jump[cell->active_cell_index()] < coarsen_threshold * largest)
            cell->set_coarsen_flag();
        keep_coarsenable(mesh, minimum_level);
        n_refined = n_coarsened = 0.;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              n_coarsened += cell->coarsen_flag_set() ? 1. : 0.;
              if (needed[cell->active_cell_index()] >
                  static_cast<unsigned int>(cell->level()))
                {
                  cell->set_refine_flag();
                  n_refined += 1.;
                }
            }
        n_refined   = Utilities::MPI::sum(n_refined, space.communicator);
        n_coarsened = Utilities::MPI::sum(n_coarsened, space.communicator);
        const double cells    = mesh.n_global_active_cells();
        const double children = 1 << dim;
        const double after    = cells + (children - 1.) * n_refined -
                             (1. - 1. / children) * n_coarsened;
        if (n_refined < 1. ||
            space.dof_handler.n_dofs() * after / cells <= maximum_unknowns)
          break;
        threshold *= 1.3;
        if (threshold > 1.)
          {
            for (const auto &cell : mesh.active_cell_iterators())
              cell->clear_refine_flag();
            n_refined = 0.;
            break;
          }
      }
    // a new mesh costs many steps: to coarsen alone should be worth it
    return n_refined > 0. ||
           n_coarsened > worthwhile * mesh.n_global_active_cells();
  }

#define INSTANTIATE(dim)                                                      \
  template double WaveRefinement::finest_part<dim>(const Space<dim> &) const; \
  template bool   WaveRefinement::mark<dim>(Space<dim> &,                     \
                                          std::vector<double> &,            \
                                          const double,                     \
                                          double &) const;

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
