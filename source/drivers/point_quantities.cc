#include <signoton/drivers/point_quantities.h>
#include <signoton/tensors/isotropic.h>

namespace Signoton
{
  namespace
  {
    Tensor2<>
    tensor_at(const PointState &state, const unsigned int place)
    {
      Tensor2<> result;
      for (unsigned int e = 0; e < 6; ++e)
        result.access_raw_entry(e) = state.values[place + e];
      return result;
    }

    void
    add_tensor(std::vector<PointQuantity> &list,
               const std::string          &name,
               const unsigned int          place,
               const unsigned int          dim)
    {
      const std::array<const char *, 6> entries = {
        {"xx", "yy", "zz", "xy", "xz", "yz"}};
      for (unsigned int e = 0; e < (dim == 2 ? 4 : 6); ++e)
        list.push_back({name + " " + entries[e], [=](const PointState &s) {
                          return s.values[place + e];
                        }});
    }
  } // namespace

  std::vector<PointQuantity>
  point_quantities(const std::vector<std::string> &wanted,
                   const unsigned int              dim)
  {
    std::vector<PointQuantity> list;
    for (const std::string &name : wanted)
      if (name == "stress")
        add_tensor(list, name, PointState::stress, dim);
      else if (name == "strain")
        add_tensor(list, name, PointState::strain, dim);
      else if (name == "contact strain")
        add_tensor(list, name, PointState::contact_strain, dim);
      else if (name == "plastic strain")
        add_tensor(list, name, PointState::plastic_strain, dim);
      else if (name == "principal stress")
        for (unsigned int i = 0; i < 3; ++i)
          list.push_back(
            {name + " " + std::to_string(i + 1), [i](const PointState &s) {
               return eigenvalues(tensor_at(s, PointState::stress))[i];
             }});
      else if (name == "pressure")
        list.push_back({name, [](const PointState &s) {
                          return pressure(tensor_at(s, PointState::stress));
                        }});
      else if (name == "shear intensity")
        list.push_back({name, [](const PointState &s) {
                          return shear_intensity(
                            dealii::deviator(tensor_at(s, PointState::stress)));
                        }});
      else if (name == "energy density")
        list.push_back({name, [](const PointState &s) {
                          return s.values[PointState::energy_density];
                        }});
      else if (name == "region")
        list.push_back({name, [](const PointState &s) {
                          return s.values[PointState::region];
                        }});
    return list;
  }
} // namespace Signoton
