#pragma once
using Force = std::variant<PointLoad>;
