#include <signoton/base/blas.h>

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <system_error>

// All is asked of the running program: another BLAS may take the place of the
// one that was linked (update-alternatives, LD_LIBRARY_PATH).

namespace Signoton
{
  namespace
  {
    /** A function of one of the libraries that are loaded, or nullptr. */
    template <typename Function>
    Function *
    loaded(const char *symbol)
    {
      return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, symbol));
    }

    /** Where the product of matrices comes from. */
    std::filesystem::path
    file()
    {
      Dl_info information;
      void   *product = dlsym(RTLD_DEFAULT, "dgemm_");
      if (product == nullptr || dladdr(product, &information) == 0 ||
          information.dli_fname == nullptr)
        return {};
      std::error_code error;
      const auto      path =
        std::filesystem::canonical(information.dli_fname, error);
      return error ? information.dli_fname : path;
    }
  } // namespace

  std::string
  BLAS::name()
  {
    if (is_reference())
      return "reference BLAS";
    if (const auto words = loaded<char *()>("openblas_get_config"))
      return words();
    return file().empty() ? "unknown BLAS" : "BLAS " + file().string();
  }

  bool
  BLAS::is_reference()
  {
    // others that take its place under its name have directories of their own
    const std::string path = file();
    return path.find("/libblas.so") != std::string::npos &&
           !std::regex_search(path, std::regex("openblas|atlas|blis|mkl"));
  }

  void
  BLAS::use_one_thread()
  {
    // these read the environment when they are first called ...
    setenv("MKL_NUM_THREADS", "1", 0);
    setenv("BLIS_NUM_THREADS", "1", 0);
    // ... but OpenBLAS when it is loaded
    for (const char *wish :
         {"OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS"})
      if (std::getenv(wish) != nullptr)
        return;
    if (const auto set = loaded<void(int)>("openblas_set_num_threads"))
      set(1);
  }
} // namespace Signoton
