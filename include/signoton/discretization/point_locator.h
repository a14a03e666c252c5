#ifndef signoton_discretization_point_locator_h
#define signoton_discretization_point_locator_h

#include <signoton/discretization/space.h>

namespace Signoton
{
  /**
   * Where given points are in the mesh, on all ranks, anew whenever the mesh has
   * changed. The cells that a rank owns ask for the points in them: a tree of
   * the few points answers faster than one of the many cells, and a point on a
   * face, an edge or a vertex, where cells of several ranks meet, is like any
   * other.
   *
   * A refined mesh follows a curved boundary and may leave a point outside, by
   * a part of the size of the cell that it was in. The closest point of the body
   * then takes its place, with a line on the screen, or it is an error.
   */
  template <int dim>
  class PointLocator
  {
  public:
    /** A point, and whose material it is asked for. */
    struct Target
    {
      unsigned int       point; ///< by its number
      types::material_id material = numbers::invalid_material_id; ///< any
    };

    /** A target in a cell of this rank. */
    struct Place
    {
      unsigned int                                      target;
      typename Triangulation<dim>::active_cell_iterator cell;
      Point<dim>                                        unit; ///< in the cell
      double share; ///< one over the number of cells that share the target
    };

    enum class Materials
    {
      together, ///< one target a point
      apart     ///< on an interface, one target for each material
    };

    /** Finds the points in the present mesh; throws UserError unless all are in
     *  the body.
     *  @param points the same on all ranks
     *  @param where  in the scene file, for messages: of each point, or of all
     *  @param takes_nearest for points that a mesh leaves outside; else they are
     *    an error */
    PointLocator(const Space<dim>               &space,
                 const std::vector<Point<dim>>  &points,
                 const std::vector<std::string> &where,
                 const Materials                 separation,
                 const bool                      takes_nearest);

    /** Throws UserError if a point has left the body too far. On all ranks. */
    const std::vector<Place> &
    places();

    /** Of a target, also where there is no choice, in the mesh of the start. */
    types::material_id
    material(const unsigned int target) const
    {
      return materials[target];
    }

    /** Sorted by point and material; they stay the same. */
    std::vector<Target> targets;

  private:
    /** The point of the body next to a target that is in none of its cells. */
    struct Nearest
    {
      double     distance  = std::numeric_limits<double>::max();
      double     cell_size = 0.; ///< diameter, in m
      Point<dim> point;
      double     bulge = 0.; ///< of the boundary over the face there, in m

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &distance &cell_size &point &bulge;
      }
    };

    /** Find targets as they are placed; returns those without a cell. */
    std::vector<unsigned int>
    locate();

    void
    find_materials(const Materials separation);

    void
    take_nearest(const std::vector<unsigned int> &missing);

    std::vector<Nearest>
    nearest(const std::vector<unsigned int> &missing) const;

    /** Take the closest point of the faces of a cell, if it is better. */
    void
    look_at_faces(const typename Triangulation<dim>::active_cell_iterator &cell,
                  const types::material_id material,
                  const Point<dim>        &lost,
                  Nearest                 &best) const;

    void
    announce(const unsigned int point, const Nearest &there);

    const std::string &
    where_is(const unsigned int point) const
    {
      return where[where.size() > 1 ? point : 0];
    }

    const Space<dim>               &space;
    const std::vector<Point<dim>>   points;
    const std::vector<std::string>  where;
    const bool                      takes_nearest;
    std::vector<types::material_id> materials; ///< of each target
    std::vector<Point<dim>>         position;  ///< of each target
    std::vector<bool>               announced; ///< of each point
    /** Diameter of the cell of each point in the mesh of the start. */
    std::vector<double>                first_size;
    std::vector<Place>                 found;
    bool                               is_current = false, is_first = true;
    boost::signals2::scoped_connection mesh_changes;
  };
} // namespace Signoton

#endif
