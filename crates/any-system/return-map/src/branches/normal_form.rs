//! The coefficients of normal forms, from second and third derivatives.
//!
//! Y. A. Kuznetsov, *Elements of Applied Bifurcation Theory*, Springer (2004), section 5.4.

use super::branch::BifurcationKind;
use super::curve::OnCurve;
use super::orbit::{Kind, Orbit};
use crate::families::MapFamily;
use crate::multipliers::{complex_null_vector, eigenvalues, null_vector};
use nalgebra::{Complex, DMatrix, DVector};

/// A second-order coefficient that is so small beside the root of the third-order one, which has its unit, belongs to a symmetric map: by
/// differences it has an error of 10⁻⁸.
const SYMMETRIC: f64 = 1e-7;

/// A coefficient so small, in units of the size of the point, is none: by differences it has an error of 10⁻⁸.
const DEGENERATE: f64 = 1e-6;

/// So near to 1 the third or fourth power of a multiplier is one: a strong resonance, in whose normal form more terms count. Beside it the
/// coefficient is large as the inverse distance.
const RESONANT: f64 = 1e-6;

pub(super) struct NormalForm {
    /// The eigenvector of the critical multiplier, or its real part, of length 1.
    pub(super) direction: Vec<f64>,
    pub(super) coefficient: Option<f64>,
    /// The second-order coefficient vanishes.
    pub(super) is_symmetric: bool,
}

/// Directional derivatives of fⁿ at a point.
struct Forms<'a, M: ?Sized> {
    orbit: &'a Orbit<'a, M>,
    at: &'a DVector<f64>,
}

type Vector = DVector<f64>;
type ComplexVector = DVector<Complex<f64>>;

impl<M: MapFamily + ?Sized> Forms<'_, M> {
    /// B(v, v)/2 and C(v, v, v)/6.
    fn powers(&self, v: &Vector) -> Option<[Vector; 2]> {
        let direction = v.clone().push(0.0);
        let image = self.orbit.pushed(self.orbit.line(self.at, &direction)).ok()?;
        let term = |k: usize| Vector::from_iterator(image.len(), image.iter().map(|jet| jet.0[k]));
        Some([term(2), term(3)])
    }

    /// B(u, v), from two vectors of the same length.
    fn second(&self, u: &Vector, v: &Vector) -> Option<Vector> {
        let (u_length, v_length) = (u.norm(), v.norm());
        if u_length == 0.0 || v_length == 0.0 {
            return Some(Vector::zeros(u.len()));
        }
        let (u, v) = (u / u_length, v / v_length);
        let [sum, _] = self.powers(&(&u + &v))?;
        let [difference, _] = self.powers(&(&u - &v))?;
        Some((sum - difference) * (0.5 * u_length * v_length))
    }

    /// C(u, u, v).
    fn third(&self, u: &Vector, v: &Vector) -> Option<Vector> {
        let cube = |w: &Vector| Some(self.powers(w)?[1].clone() * 6.0);
        Some((cube(&(u + v))? - cube(&(u - v))?) / 6.0 - cube(v)? / 3.0)
    }
}

pub(super) fn normal_form<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    kind: BifurcationKind,
    at: &OnCurve,
) -> Option<NormalForm> {
    let matrix = orbit.derivative(&at.slopes);
    let forms = Forms { orbit, at: &at.at };
    match kind {
        BifurcationKind::Fold | BifurcationKind::Transcritical | BifurcationKind::Pitchfork => {
            real_form(&forms, &matrix, orbit.kind.at_fold(), kind)
        }
        BifurcationKind::Doubling => real_form(&forms, &matrix, -1.0, kind),
        BifurcationKind::NeimarkSacker | BifurcationKind::Hopf => circle_form(&forms, &matrix),
    }
}

/// The normal form at a real multiplier.
fn real_form<M: MapFamily + ?Sized>(
    forms: &Forms<'_, M>,
    matrix: &DMatrix<f64>,
    multiplier: f64,
    kind: BifurcationKind,
) -> Option<NormalForm> {
    let n = matrix.nrows();
    let identity = DMatrix::<f64>::identity(n, n);
    let shifted = matrix - &identity * multiplier;
    let q = null_vector(&shifted)?;
    let p = null_vector(&shifted.transpose())?;
    let p = &p / p.dot(&q);
    let direction = q.iter().copied().collect();
    let Some([half_b, sixth_c]) = forms.powers(&q) else {
        return Some(NormalForm { direction, coefficient: None, is_symmetric: false });
    };
    let second = p.dot(&half_b);
    let b = &half_b * 2.0;
    // At the multiplier 1 the inverse of A − 1 is taken on vectors without a part along q.
    let fixed = &identity * forms.orbit.kind.at_fold();
    let bent = match multiplier < 0.0 {
        true => (&fixed - matrix).lu().solve(&b),
        false => {
            let side = (&b - &q * p.dot(&b)).push(0.0);
            let mut bordered = (&fixed - matrix).insert_row(n, 0.0).insert_column(n, 0.0);
            bordered.view_mut((n, 0), (1, n)).copy_from(&p.transpose());
            bordered.view_mut((0, n), (n, 1)).copy_from(&q);
            bordered.lu().solve(&side).map(|solution| solution.rows(0, n).into_owned())
        }
    };
    let third =
        bent.and_then(|bent| forms.second(&q, &bent)).map(|mixed| p.dot(&(&sixth_c + mixed * 0.5)));
    // Where both vanish, as at a fold of higher order, no coefficient tells what happens.
    let size = forms.orbit.scales[0];
    let is_symmetric = third.is_some_and(|third| {
        second.abs() <= SYMMETRIC * third.abs().sqrt() && third.abs() * size * size > DEGENERATE
    });
    let coefficient = match kind {
        BifurcationKind::Transcritical if !is_symmetric && second.abs() * size <= DEGENERATE => {
            None
        }
        BifurcationKind::Fold => Some(second),
        BifurcationKind::Transcritical if !is_symmetric => Some(second),
        _ => third,
    };
    Some(NormalForm { direction, coefficient: coefficient.filter(|c| c.is_finite()), is_symmetric })
}

/// The normal form at two multipliers on the unit circle, or at two eigenvalues on the imaginary axis.
fn circle_form<M: MapFamily + ?Sized>(
    forms: &Forms<'_, M>,
    matrix: &DMatrix<f64>,
) -> Option<NormalForm> {
    let on_circle = |m: &&Complex<f64>| m.im > 0.0;
    let values = eigenvalues(matrix);
    let critical = values.iter().filter(on_circle);
    // e^(iθ), or iω, with its square, or its double.
    let kind = forms.orbit.kind;
    let off = |m: &Complex<f64>| match kind {
        Kind::Periodic(_) => (m.norm() - 1.0).abs(),
        Kind::Equilibrium => m.re.abs(),
    };
    let multiplier = *critical.min_by(|a, b| off(a).total_cmp(&off(b)))?;
    let (multiplier, second_harmonic, unit) = match kind {
        Kind::Periodic(_) => {
            let multiplier = multiplier / multiplier.norm();
            (multiplier, multiplier * multiplier, multiplier.conj())
        }
        Kind::Equilibrium => {
            let multiplier = Complex::new(0.0, multiplier.im);
            (multiplier, multiplier * 2.0, Complex::new(1.0 / multiplier.im, 0.0))
        }
    };
    let n = matrix.nrows();
    let complex = |matrix: &DMatrix<f64>| matrix.map(|entry| Complex::new(entry, 0.0));
    let a = complex(matrix);
    let identity = DMatrix::<Complex<f64>>::identity(n, n);
    let q = complex_null_vector(&(&a - &identity * multiplier))?;
    let p = complex_null_vector(&(a.transpose() - &identity * multiplier.conj()))?;
    let p = &p / p.dotc(&q).conj();
    let (re, im) = (q.map(|x| x.re), q.map(|x| x.im));
    let direction = re.iter().copied().collect();
    let coefficient = (|| {
        let rr = forms.second(&re, &re)?;
        let ii = forms.second(&im, &im)?;
        let ri = forms.second(&re, &im)?;
        let qq = ComplexVector::from_fn(n, |k, _| Complex::new(rr[k] - ii[k], 2.0 * ri[k]));
        let q_conjugate = (&rr + &ii).map(|x| Complex::new(x, 0.0));
        let bent = (&identity * Complex::new(kind.at_fold(), 0.0) - &a).lu().solve(&q_conjugate)?;
        let turned = (&identity * second_harmonic - &a).lu().solve(&qq)?;
        // B(u, v) of complex vectors.
        let second = |u: &ComplexVector, v: &ComplexVector| {
            let parts = |w: &ComplexVector| [w.map(|x| x.re), w.map(|x| x.im)];
            let ([ur, ui], [vr, vi]) = (parts(u), parts(v));
            let (rr, ii) = (forms.second(&ur, &vr)?, forms.second(&ui, &vi)?);
            let (ri, ir) = (forms.second(&ur, &vi)?, forms.second(&ui, &vr)?);
            Some(ComplexVector::from_fn(n, |k, _| Complex::new(rr[k] - ii[k], ri[k] + ir[k])))
        };
        let cubes = [
            forms.third(&re, &re)? + forms.third(&im, &re)?,
            forms.third(&re, &im)? + forms.third(&im, &im)?,
        ];
        let cubic = ComplexVector::from_fn(n, |k, _| Complex::new(cubes[0][k], cubes[1][k]));
        let two = Complex::new(2.0, 0.0);
        let all = cubic + second(&q, &bent)? * two + second(&q.conjugate(), &turned)?;
        Some(0.5 * (unit * p.dotc(&all)).re)
    })();
    let is_resonant = matches!(kind, Kind::Periodic(_))
        && [3, 4].iter().any(|power| (multiplier.powi(*power) - 1.0).norm() < RESONANT);
    let coefficient = coefficient.filter(|c: &f64| c.is_finite() && !is_resonant);
    Some(NormalForm { direction, coefficient, is_symmetric: false })
}
