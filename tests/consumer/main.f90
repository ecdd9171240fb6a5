! SPDX-License-Identifier: MIT OR Apache-2.0
! A project of Fortran alone: a unit sphere through the C interface, and its value at two points.
program consumer
  use, intrinsic :: iso_c_binding
  implicit none
  interface
    function emb_geom_sphere(center, radius, out_geom) bind(c) result(status)
      import :: c_double, c_int32_t, c_ptr
      real(c_double), intent(in) :: center(3)
      real(c_double), value :: radius
      type(c_ptr), intent(out) :: out_geom
      integer(c_int32_t) :: status
    end function
    function emb_geom_value(g, x, y, z) bind(c) result(value)
      import :: c_double, c_ptr
      type(c_ptr), value :: g
      real(c_double), value :: x, y, z
      real(c_double) :: value
    end function
    subroutine emb_geom_free(g) bind(c)
      import :: c_ptr
      type(c_ptr), value :: g
    end subroutine
    function emb_version_number() bind(c) result(version)
      import :: c_int32_t
      integer(c_int32_t) :: version
    end function
  end interface
  type(c_ptr) :: sphere

  if (emb_geom_sphere([0d0, 0d0, 0d0], 1d0, sphere) /= 0) error stop "emb_geom_sphere failed"
  if (emb_geom_value(sphere, 0d0, 0.5d0, 0d0) /= -0.5d0) error stop "inside is not negative"
  if (emb_geom_value(sphere, 0d0, 0d0, 3d0) /= 2d0) error stop "outside is not positive"
  call emb_geom_free(sphere)
  print "(a,i0)", "version ", emb_version_number()
end program
