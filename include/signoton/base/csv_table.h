#ifndef signoton_base_csv_table_h
#define signoton_base_csv_table_h

#include <signoton/base/output_file.h>

#include <vector>

namespace Signoton
{
  /**
   * A table that grows on disk, row by row, and is gone on with after a
   * restart: the one format of all numbers that a run writes (CSV, RFC 4180).
   *
   * The first line has the names of the columns, in double quotes; each
   * further one a row of numbers with 12 digits, separated by commas. An empty
   * field is a number that was not asked for; a block of rows may end with an
   * empty line, which gnuplot takes for the end of a scan, and others skip.
   */
  class CSVTable
  {
  public:
    using Names   = std::vector<std::string>;
    using Numbers = std::vector<double>;
    /** Numbers with the names of their columns. */
    using Row = std::vector<std::pair<std::string, double>>;

    /** @param file_name of which nothing is touched until append() */
    CSVTable(const MPI_Comm &communicator, const std::string &file_name);

    /** Go on with what the file has.
     *  @param n_blocks that are kept; the rest is dropped when the next row
     *    comes
     *  @param by_lines whether each row is a block, or what ends with an empty
     *    line */
    void
    resume(const std::size_t n_blocks, const bool by_lines);

    /**
     * Append rows; the first ones begin the file. Collective.
     *
     * After resume(), numbers go below their names: columns that are new are
     * empty before, columns that are gone stand last and are empty from now on.
     * @return a sentence about such columns, empty if there are none or on
     *   other ranks than the first
     */
    std::string
    append(const Names                &names,
           const std::vector<Numbers> &rows,
           const bool                  ends_block = false);

    std::string
    append(const Row &row);

    /** All rows of a file; empty fields are left out. */
    static std::vector<Row>
    read(const std::string &file_name);

  private:
    /** Lines of the file. */
    static std::string
    header(const Names &names);
    static std::string
    line(const Numbers &row);

    /** Fields as they stand in the file. */
    using Fields = std::vector<std::string>;

    static Fields
    split(const std::string &line);

    /** Give the rows that are kept these columns, and those that they have
     *  besides; says what changed. */
    std::string
    rearrange(const Names &names);

    MPI_Comm            communicator;
    std::string         file_name;
    bool                has_begun = false;
    Names               old_names;
    std::vector<Fields> old_rows; ///< to be written with the next row
    std::string         padding;  ///< of rows without some of the columns
  };
} // namespace Signoton

#endif
