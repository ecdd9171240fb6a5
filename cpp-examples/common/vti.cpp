// SPDX-License-Identifier: MIT OR Apache-2.0
// VTK's XML format with raw appended data: an XML head, an underscore, then for each array its size
// in bytes (here 64 bits) and its bytes, in the byte order that the head names.
#include "vti.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace {

const char *byte_order() {
    const std::uint16_t one = 1;
    unsigned char first = 0;
    std::memcpy(&first, &one, 1);
    return first == 1 ? "LittleEndian" : "BigEndian";
}

std::string head(const Grid &grid) {
    std::ostringstream extent, text;
    extent << "0 " << grid.n(0) - 1 << " 0 " << grid.n(1) - 1 << " 0 " << grid.n(2) - 1;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << "<?xml version=\"1.0\"?>\n"
         << "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"" << byte_order() << "\" header_type=\"UInt64\">\n"
         << "  <ImageData WholeExtent=\"" << extent.str() << "\" Origin=\"" << grid.nodes[0][0] << ' ' << grid.nodes[1][0] << ' '
         << grid.nodes[2][0] << "\" Spacing=\"" << grid.spacing(0) << ' ' << grid.spacing(1) << ' ' << grid.spacing(2) << "\">\n"
         << "    <Piece Extent=\"" << extent.str() << "\">\n"
         << "      <PointData Scalars=\"distance\">\n"
         << "        <DataArray type=\"Float64\" Name=\"distance\" format=\"appended\" offset=\"0\"/>\n"
         << "      </PointData>\n"
         << "    </Piece>\n"
         << "  </ImageData>\n"
         << "  <AppendedData encoding=\"raw\">\n_";
    return text.str();
}

} // namespace

void write_vti(const std::string &path, const Grid &grid) {
    std::ofstream file(path, std::ios::binary);
    file << head(grid);
    const std::uint64_t bytes = grid.values.size() * sizeof(double);
    file.write(reinterpret_cast<const char *>(&bytes), sizeof bytes);
    file.write(reinterpret_cast<const char *>(grid.values.data()), static_cast<std::streamsize>(bytes));
    file << "\n  </AppendedData>\n</VTKFile>\n";
    file.close();
    if (!file) {
        throw std::runtime_error(path + ": cannot be written");
    }
}
